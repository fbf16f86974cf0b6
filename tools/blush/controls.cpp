/// blush controls: what can be set on a face, and what each control does.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "rig/controls/rig.h"
#include "runtime/files/face_file.h"
#include "runtime/files/rig_description_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

using Json = nlohmann::ordered_json;

/// Every control alone at 1.
class Sheet {
public:
    explicit Sheet(const Rig& rig) : rig_(rig), controls_(rig.control_names().size(), 0.0F), pose_(rig.rest_pose()) {}

    Json describe(std::size_t index) {
        const auto control = static_cast<ControlId>(index);
        const ControlInfo& info = rig_.info(control);
        Json json = {{"name", rig_.control_names()[index]},
                     {"kind", name_of(info.kind)},
                     {"low", info.low},
                     {"high", info.high}};
        if (!info.meaning.empty()) json["meaning"] = info.meaning;
        if (info.kind != ControlKind::target) {
            json["drives"] = Json::object();
            for (const RigProgram::Link& link : rig_.drives(control)) {
                Json& weight = json["drives"][rig_.control_names()[link.control]];
                weight = (weight.is_null() ? 0.0F : weight.get<float>()) + link.weight;
            }
        }
        controls_[index] = 1;
        rig_.evaluate(controls_, pose_);
        controls_[index] = 0;
        add(json, "wrinkles", rig_.wrinkle_zones(), pose_.wrinkles);
        add(json, "hemoglobin", rig_.hemoglobin_maps(), pose_.hemoglobin);
        if (pose_.hemoglobin_factor != 1) json["hemoglobin_factor"] = pose_.hemoglobin_factor;
        return json;
    }

private:
    static void add(Json& json, const char* key, std::span<const std::string> names, const std::vector<float>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] != 0) json[key][names[i]] = values[i];
        }
    }

    const Rig& rig_;
    std::vector<float> controls_;
    Pose pose_;
};

Json describe(const Face& face, const RigDescription& description, const Rig& rig) {
    Json json;
    json["file"] = face.path;
    json["rig"] = description.path.empty() ? Json() : Json(description.path);
    json["controls"] = Json::array();
    Sheet sheet(rig);
    for (std::size_t c = 0; c < rig.control_names().size(); ++c) json["controls"].push_back(sheet.describe(c));
    json["in_betweens"] = Json::array();
    for (const InBetween& in_between : description.in_betweens) {
        json["in_betweens"].push_back(
            {{"shape", in_between.shape}, {"target", in_between.target}, {"at", in_between.at}});
    }
    json["correctives"] = Json::array();
    for (const Corrective& corrective : description.correctives) {
        json["correctives"].push_back({{"target", corrective.target},
                                       {"drivers", corrective.drivers},
                                       {"rule", corrective.rule == CorrectiveRule::product ? "product" : "minimum"}});
    }
    json["wrinkle_zones"] = rig.wrinkle_zones();
    json["hemoglobin_maps"] = rig.hemoglobin_maps();
    json["unmatched_arkit"] = rig.unmatched_arkit();
    json["unmatched_drives"] = rig.unmatched_drives();
    return json;
}

std::string listed(const Json& weights) {
    std::string text;
    for (const auto& [name, weight] : weights.items()) {
        char number[32];
        std::snprintf(number, sizeof number, " %.3g", weight.get<double>());
        text += (text.empty() ? "" : ", ") + name + number;
    }
    return text;
}

void print_control(const Json& control) {
    std::string line;
    const auto add = [&](const std::string& part) { line += (line.empty() ? "" : "; ") + part; };
    if (control.contains("meaning")) add(control["meaning"].get<std::string>());
    if (control.contains("drives") && !control["drives"].empty()) add("drives " + listed(control["drives"]));
    if (control.contains("wrinkles")) add("wrinkles " + listed(control["wrinkles"]));
    if (control.contains("hemoglobin")) add("blood " + listed(control["hemoglobin"]));
    if (control.contains("hemoglobin_factor"))
        add("all blood times " + control["hemoglobin_factor"].dump().substr(0, 5));
    std::cout << "  " << control["name"].get<std::string>() << (line.empty() ? "" : ": ") << line << "\n";
}

void print_names(const char* what, const Json& names) {
    std::cout << "\n" << what << " (" << names.size() << ")\n";
    for (const Json& name : names) std::cout << "  " << name.get<std::string>() << "\n";
}

void print(const Json& json) {
    std::cout << json["file"].get<std::string>() << ": " << json["controls"].size() << " controls, rig "
              << (json["rig"].is_null() ? "by the names of the targets" : json["rig"].get<std::string>()) << "\n";
    std::string kind;
    for (const Json& control : json["controls"]) {
        if (control["kind"] != kind) {
            kind = control["kind"].get<std::string>();
            const auto count =
                std::ranges::count_if(json["controls"], [&](const Json& c) { return c["kind"] == kind; });
            std::cout << "\n"
                      << kind << "s (" << count << "), " << control["low"].get<float>() << " to "
                      << control["high"].get<float>() << (kind == "angle" ? " radians" : "") << "\n";
        }
        print_control(control);
    }
    if (!json["in_betweens"].empty()) {
        std::cout << "\nin-betweens (" << json["in_betweens"].size() << ")\n";
        for (const Json& in_between : json["in_betweens"]) {
            std::cout << "  " << in_between["target"].get<std::string>() << ": "
                      << in_between["shape"].get<std::string>() << " at " << in_between["at"].get<float>() << "\n";
        }
    }
    if (!json["correctives"].empty()) {
        std::cout << "\ncorrectives (" << json["correctives"].size() << ")\n";
        for (const Json& corrective : json["correctives"]) {
            std::cout << "  " << corrective["target"].get<std::string>() << ": "
                      << corrective["rule"].get<std::string>() << " of";
            for (const Json& driver : corrective["drivers"]) std::cout << " " << driver.get<std::string>();
            std::cout << "\n";
        }
    }
    print_names("ARKit shapes without a match", json["unmatched_arkit"]);
    print_names("what expressions find no shape for", json["unmatched_drives"]);
}

int controls(const std::string& face_name, const std::string& rig_name, bool as_json) {
    const Result<Face> face = load_face(face_path(face_name));
    if (!face) return fail(face.error());
    const Result<RigDescription> description = find_rig_description(*face, rig_name);
    if (!description) return fail(description.error());
    const Json json = describe(*face, *description, Rig(*face, *description));
    if (as_json) {
        // Names come from a file and may be no valid UTF-8: such bytes are replaced.
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
    } else {
        print(json);
    }
    return 0;
}

}  // namespace

void add_controls(Command& program) {
    struct Options {
        std::string face, rig;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("controls", "List what can be set on a face, and what each control does");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    command.option("--rig", &options->rig, "A rig description; FACE.rig.json where this is left out and there is one");
    command.flag("--json", options->json, "Print JSON");
    command.runs([options] { return controls(options->face, options->rig, options->json); });
}

}  // namespace blush::tool
