#include "runtime/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace blush {

Camera OrbitCamera::camera(float aspect) const {
    const float pitch = std::clamp(pitch_radians, -1.5F, 1.5F);
    const glm::dvec3 towards(std::sin(yaw_radians) * std::cos(pitch), std::sin(pitch),
                             std::cos(yaw_radians) * std::cos(pitch));
    // The near plane keeps 1/500 of the distance at least: depth precision falls with near/far.
    const float near_plane = std::max(distance - 2 * scene_radius, distance * 0.002F);
    const float far_plane = distance + 2 * scene_radius;
    return {glm::lookAtRH(target_world + static_cast<double>(distance) * towards, target_world, glm::dvec3(0, 1, 0)),
            glm::perspectiveRH_NO(vertical_field_of_view_radians, aspect, near_plane, far_plane)};
}

Bounds portrait(const Bounds& bounds, const FaceScale& scale) {
    if (bounds.empty() || scale.is_guess) return bounds;
    const auto units_a_millimetre = static_cast<float>(1 / scale.millimetres_a_unit);
    Bounds shown = bounds;
    shown.low.y = std::max(bounds.low.y, bounds.high.y - 270 * units_a_millimetre);
    const float middle = bounds.centre().x, half_width = 125 * units_a_millimetre;
    shown.low.x = std::max(bounds.low.x, middle - half_width);
    shown.high.x = std::min(bounds.high.x, middle + half_width);
    return shown;
}

OrbitCamera frame_head(const Bounds& bounds, const FaceScale& scale, float aspect) {
    OrbitCamera camera;
    const glm::vec3 whole = bounds.empty() ? glm::vec3(0) : bounds.size();
    const float extent = std::max({whole.x, whole.y, whole.z});
    if (!std::isfinite(extent) || !(extent > 0)) return camera;
    const Bounds shown = portrait(bounds, scale);
    const glm::vec3 size = shown.size();
    const glm::vec3 target = shown.centre();
    camera.target_world = target;
    // From the target to the farthest corner of everything, since the planes must hold what the portrait leaves out.
    const glm::vec3 farthest = glm::max(bounds.high - target, target - bounds.low);
    camera.scene_radius = glm::length(farthest);
    // The front of the box fills 1 / margin of the narrower side.
    constexpr float margin = 1.12F;
    const float half_tangent = std::tan(0.5F * camera.vertical_field_of_view_radians);
    const float half_height = 0.5F * margin * std::max(size.y, size.x / aspect);
    camera.distance = half_height / half_tangent + 0.5F * size.z;
    return camera;
}

}  // namespace blush
