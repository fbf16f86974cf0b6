#include "rig/rig.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace blush {
namespace {

constexpr std::array<std::string_view, 9> angle_names = {
    "headYaw",     "headPitch",   "headRoll",      "leftEyeYaw",   "leftEyePitch",
    "leftEyeRoll", "rightEyeYaw", "rightEyePitch", "rightEyeRoll",
};

float finite_or_zero(float value) { return std::isfinite(value) ? value : 0.0F; }

Angles angles_from(std::span<const float> yaw_pitch_roll) {
    return {.yaw_radians = finite_or_zero(yaw_pitch_roll[0]),
            .pitch_radians = finite_or_zero(yaw_pitch_roll[1]),
            .roll_radians = finite_or_zero(yaw_pitch_roll[2])};
}

}  // namespace

Rig::Rig(const Face& face) : target_count_(face.targets.size()) {
    names_.reserve(target_count_ + angle_names.size());
    for (const Target& target : face.targets) names_.push_back(target.name);
    names_.insert(names_.end(), angle_names.begin(), angle_names.end());
    index_ = NameIndex(names_);
    node_rest_.reserve(face.nodes.size());
    for (const Node& node : face.nodes) node_rest_.push_back(node.rest);
}

std::optional<ControlId> Rig::find(std::string_view name) const {
    const std::optional<std::size_t> index = index_.find(name);
    if (!index) return std::nullopt;
    return static_cast<ControlId>(*index);
}

Pose Rig::rest_pose() const {
    Pose pose;
    pose.weights.assign(target_count_, 0.0F);
    pose.nodes = node_rest_;
    return pose;
}

void Rig::evaluate(std::span<const float> controls, Pose& pose) const {
    assert(controls.size() == names_.size() && "Rig::evaluate() takes one value for each control");
    assert(pose.weights.size() == target_count_ && "Rig::evaluate() takes a pose from rest_pose()");
    for (std::size_t i = 0; i < target_count_; ++i) {
        pose.weights[i] = std::clamp(finite_or_zero(controls[i]), -largest_weight, largest_weight);
    }
    const std::span<const float> angles = controls.subspan(target_count_);
    pose.head = angles_from(angles.subspan(0, 3));
    pose.left_eye = angles_from(angles.subspan(3, 3));
    pose.right_eye = angles_from(angles.subspan(6, 3));
}

}  // namespace blush
