/// What can be odd about a rig description that loads.

#include <algorithm>
#include <set>

#include "rig/controls/control_table.h"
#include "rig/names.h"
#include "runtime/files/face_file.h"
#include "runtime/files/rig_description_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/lint.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

class RigLint {
public:
    RigLint(const Face& face, const RigDescription& rig) : rig_(rig), table_(face, rig) {}

    Findings run() {
        for (std::size_t i = 0; i < rig_.expressions.size(); ++i) expression(i);
        correctives();
        for (const Limit& limit : rig_.limits) {
            if (limit.low == 0 && limit.high == 0) add("limits." + limit.control, "nothing can move it");
        }
        wrinkles();
        hemoglobin();
        return std::move(findings_);
    }

private:
    void add(const std::string& place, const std::string& sentence) { findings_.push_back({place, sentence}); }

    void expression(std::size_t index) {
        const Expression& expression = rig_.expressions[index];
        const std::string place = plural_of(expression.kind) + "." + expression.name;
        const bool own = table_.infos[table_.of_expression[index]].kind == ControlKind::target;
        if (own && !expression.drives.empty()) {
            add(place, "the face has a target of this name, so that its drives count for nothing");
            return;
        }
        for (const Drive& drive : expression.drives) {
            const std::string at = place + ".drives." + drive.control;
            if (table_.driven_by(drive.control).empty()) add(at, "this face has no such shape");
            if (drive.weight == 0) add(at, "its weight is 0");
            if (drive.weight > 1) add(at, "its weight is above 1: it gets to the end of its range early");
        }
    }

    void correctives() {
        std::set<std::uint32_t> driven;
        for (const Expression& expression : rig_.expressions) {
            for (const Drive& drive : expression.drives) {
                for (const ControlShare& share : table_.driven_by(drive.control)) driven.insert(share.control);
            }
        }
        for (std::size_t i = 0; i < rig_.correctives.size(); ++i) {
            const Corrective& corrective = rig_.correctives[i];
            const std::string place = "correctives[" + std::to_string(i) + "]";
            if (corrective.weight == 0) add(place + ".weight", "it is 0");
            if (driven.contains(table_.find(corrective.target).value())) {
                add(place + ".target", "expressions drive '" + corrective.target + "' too");
            }
            for (const std::string& driver : corrective.drivers) {
                if (!table_.find(driver)) add(place, "this face has no '" + driver + "': it never acts");
            }
        }
    }

    void wrinkles() {
        for (std::size_t zone = 0; zone < rig_.wrinkle_zones.size(); ++zone) {
            const bool wrinkles =
                std::ranges::any_of(rig_.wrinkles, [&](const WrinkleRow& row) { return row.weights[zone] > 0; });
            if (!wrinkles) add("wrinkles.zones." + rig_.wrinkle_zones[zone].name, "nothing wrinkles it");
        }
    }

    void hemoglobin() {
        for (const std::string& map : rig_.hemoglobin_maps) {
            const bool shared = std::ranges::any_of(
                rig_.hemoglobin, [&](const HemoglobinRow& row) { return row.map == map && row.share > 0; });
            if (!shared) add("hemoglobin.maps", "nothing has a share of '" + map + "'");
        }
    }

    const RigDescription& rig_;
    const ControlTable table_;
    Findings findings_;
};

/// head.rig.json: head.glb, head.gltf or head.obj beside it.
fs::path face_beside(const fs::path& rig) {
    const std::string stem = rig.string().substr(0, rig.string().size() - std::string_view(".rig.json").size());
    for (const char* ending : {".glb", ".gltf", ".obj"}) {
        std::error_code ignored;
        if (fs::exists(stem + ending, ignored)) return stem + ending;
    }
    return {};
}

}  // namespace

Result<Findings> lint_rig(const fs::path& file, const std::string& face_name) {
    const fs::path face_file = face_name.empty() ? face_beside(file) : face_path(face_name);
    if (face_file.empty()) return Error{file.string() + ": no face stands beside it; name one by --face"};
    const Result<Face> face = load_face(face_file);
    if (!face) return face.error();
    const Result<RigDescription> rig = load_rig_description(file, *face);
    if (!rig) return rig.error();
    return RigLint(*face, *rig).run();
}

}  // namespace blush::tool
