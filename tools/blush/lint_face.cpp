/// What can be odd about a face that loads.

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>

#include "rig/controls/head_and_eyes.h"
#include "rig/controls/rig.h"
#include "rig/far_vertices.h"
#include "rig/head/face_scale.h"
#include "rig/names.h"
#include "runtime/files/face_file.h"
#include "runtime/files/rig_description_file.h"
#include "tools/blush/lint.h"

namespace blush::tool {
namespace {

class FaceLint {
public:
    explicit FaceLint(const Face& face) : face_(face) {}

    Findings run() {
        for (const std::string& note : face_.notes) add("file", note);
        names();
        sides();
        arkit();
        for (const Target& target : face_.targets) shape(target);
        equal_shapes();
        surface();
        places();
        pivots();
        rig();
        return std::move(findings_);
    }

private:
    void add(const std::string& place, const std::string& sentence) { findings_.push_back({place, sentence}); }
    static std::string place_of(const Target& target) { return "targets." + target.name; }

    void names() {
        std::map<std::string, const Target*> by_fold;
        for (const Target& target : face_.targets) {
            if (target.name.empty()) add("targets", "one has no name");
            const auto [entry, added] = by_fold.try_emplace(canonical_name(target.name), &target);
            if (added) continue;
            const bool identical = entry->second->name == target.name;
            add(place_of(target), identical
                                      ? "two targets have this name; controls reach the first one alone"
                                      : "'" + entry->second->name +
                                            "' is another spelling of the same name; other spellings reach neither");
        }
    }

    void sides() {
        std::set<std::string> folded;
        for (const Target& target : face_.targets) folded.insert(canonical_name(target.name));
        for (const Target& target : face_.targets) {
            const std::string name = canonical_name(target.name);
            for (const auto& [side, other] : {std::pair{"left", "right"}, std::pair{"right", "left"}}) {
                if (!name.ends_with(side)) continue;
                const std::string twin = name.substr(0, name.size() - std::string_view(side).size()) + other;
                if (!folded.contains(twin)) add(place_of(target), std::string("it has no twin on the ") + other);
            }
        }
    }

    void arkit() {
        const Rig rig(face_);
        const auto unmatched = rig.unmatched_arkit();
        if (unmatched.size() == arkit_names.size()) {
            add("targets", "none of ARKit's names has a match: performances and emotions have nothing to move");
            return;
        }
        for (const std::string& name : unmatched) add("targets", "ARKit's " + name + " has no match");
        const std::vector<std::string> missing(unmatched.begin(), unmatched.end());
        for (const Target& target : face_.targets) {
            if (const auto near = nearest_name(target.name, missing); near && is_near(target.name, *near)) {
                add(place_of(target), "is this ARKit's " + *near + "?");
            }
        }
    }
    /// nearest_name() offers what shares two thirds; a slip of the pen keeps the length.
    static bool is_near(const std::string& name, const std::string& near) {
        const auto a = canonical_name(name).size(), b = canonical_name(near).size();
        return std::max(a, b) - std::min(a, b) <= 1;
    }

    void shape(const Target& target) {
        const bool moves =
            std::ranges::any_of(target.position_deltas, [](glm::vec3 delta) { return delta != glm::vec3(0); });
        if (!moves) add(place_of(target), "it moves nothing");
        if (target.default_weight != 0) {
            add(place_of(target), "the file starts it at " + std::to_string(target.default_weight) +
                                      ", but a face here starts at rest (--defaults takes the file's weights)");
        }
        float largest = 0;
        for (const glm::vec3 delta : target.position_deltas) largest = std::max(largest, glm::length(delta));
        if (moves && largest > half_size()) add(place_of(target), "it moves a vertex by more than half the face");
    }

    float half_size() {
        if (half_size_ < 0) {
            Bounds bounds;
            for (const glm::vec3 position : face_.positions) bounds.add(position);
            half_size_ = bounds.empty() ? 0 : 0.5F * glm::length(bounds.size());
        }
        return half_size_;
    }

    void equal_shapes() {
        std::unordered_map<std::size_t, std::vector<const Target*>> by_size;
        for (const Target& target : face_.targets) {
            if (target.vertices.empty()) continue;
            for (const Target* other : by_size[target.vertices.size()]) {
                if (other->vertices != target.vertices || other->position_deltas != target.position_deltas) continue;
                add(place_of(target), "it is the same shape as '" + other->name + "'");
                break;
            }
            by_size[target.vertices.size()].push_back(&target);
        }
    }

    void surface() {
        std::size_t flat = 0;
        std::vector<std::uint8_t> used(face_.positions.size(), 0);
        for (std::size_t i = 0; i + 2 < face_.indices.size(); i += 3) {
            const std::uint32_t a = face_.indices[i], b = face_.indices[i + 1], c = face_.indices[i + 2];
            used[a] = used[b] = used[c] = 1;
            const glm::vec3 normal =
                glm::cross(face_.positions[b] - face_.positions[a], face_.positions[c] - face_.positions[a]);
            if (normal == glm::vec3(0)) ++flat;
        }
        const auto unused = std::ranges::count(used, std::uint8_t{0});
        if (flat > 0)
            add("triangles",
                std::to_string(flat) + " of " + std::to_string(face_.indices.size() / 3) + " have no area");
        if (unused > 0) add("vertices", std::to_string(unused) + " belong to no triangle");
    }

    void places() {
        // A pore is some 0.05 mm deep.
        constexpr double coarse_mm = 0.05;
        const double step_mm = float_step(face_) * face_scale(face_).millimetres_a_unit;
        if (!(step_mm > coarse_mm)) return;
        std::ostringstream sentence;
        sentence << "they are baked so far from the origin that neighbouring floats are " << step_mm
                 << " mm apart; a node's translation keeps them fine";
        add("vertices", sentence.str());
    }

    void pivots() {
        const HeadAndEyes pivots = find_head_and_eyes(face_);
        if (pivots.left_eye.node < 0) add("nodes", "none is a left eye: its angles turn nothing");
        if (pivots.right_eye.node < 0) add("nodes", "none is a right eye: its angles turn nothing");
    }

    void rig() {
        const Result<RigDescription> description = find_rig_description(face_);
        if (!description) add("rig", description.error().message);
    }

    const Face& face_;
    Findings findings_;
    float half_size_ = -1;
};

}  // namespace

Result<Findings> lint_face(const std::filesystem::path& file, const std::string&) {
    const Result<Face> face = load_face(file);
    if (!face) return face.error();
    return FaceLint(*face).run();
}

}  // namespace blush::tool
