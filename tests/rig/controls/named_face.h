#pragma once
/// Faces of which only the target names matter, and their rigs.

#include <string>
#include <utility>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/names.h"

namespace blush::test {

inline Face named_face(const std::vector<std::string>& targets) {
    Face face;
    face.path = "face.glb";
    for (const std::string& name : targets) {
        Target target;
        target.name = name;
        face.targets.push_back(target);
    }
    return face;
}

inline Face arkit_face() { return named_face({arkit_names.begin(), arkit_names.end()}); }

/// Sides as _L and _R, the inner brow and the puffed cheek split, no tongue: as USC's ICT-FaceKit has them.
inline Face split_face() {
    std::vector<std::string> names;
    for (const std::string_view name : arkit_names) {
        std::string own(name);
        if (own == "tongueOut") continue;
        if (own == "browInnerUp" || own == "cheekPuff") {
            names.insert(names.end(), {own + "_L", own + "_R"});
            continue;
        }
        if (own != "jawLeft" && own != "mouthLeft" && own.ends_with("Left")) own.replace(own.size() - 4, 4, "_L");
        if (own != "jawRight" && own != "mouthRight" && own.ends_with("Right")) own.replace(own.size() - 5, 5, "_R");
        names.push_back(own);
    }
    return named_face(names);
}

/// A rig with one value a control.
class PosedRig {
public:
    explicit PosedRig(const Face& face) : PosedRig(face, default_description(face)) {}
    PosedRig(const Face& face, const RigDescription& description)
        : rig(face, description), controls(rig.control_names().size(), 0.0F), pose(rig.rest_pose()) {}

    std::size_t at(std::string_view name) const { return static_cast<std::size_t>(rig.find(name).value()); }

    /// The pose with these controls set and all others at 0.
    const Pose& with(const std::vector<std::pair<std::string_view, float>>& values) {
        controls.assign(controls.size(), 0.0F);
        for (const auto& [name, value] : values) controls[at(name)] = value;
        rig.evaluate(controls, pose);
        return pose;
    }
    float weight(std::string_view target) const { return pose.weights.at(at(target)); }
    float zone(std::string_view name) const { return entry(rig.wrinkle_zones(), pose.wrinkles, name); }
    float blood(std::string_view map) const { return entry(rig.hemoglobin_maps(), pose.hemoglobin, map); }

    Rig rig;
    std::vector<float> controls;
    Pose pose;

private:
    static float entry(std::span<const std::string> names, const std::vector<float>& values, std::string_view name) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (names[i] == name) return values.at(i);
        }
        throw std::out_of_range(std::string(name));
    }
};

}  // namespace blush::test
