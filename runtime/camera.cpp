#include "runtime/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace blush {

Camera OrbitCamera::camera(float aspect) const {
    const float pitch = std::clamp(pitch_radians, -1.5F, 1.5F);
    const glm::vec3 towards(std::sin(yaw_radians) * std::cos(pitch), std::sin(pitch),
                            std::cos(yaw_radians) * std::cos(pitch));
    // The near plane keeps 1/500 of the distance at least: depth precision falls with near/far.
    const float near_plane = std::max(distance - 2 * scene_radius, distance * 0.002F);
    const float far_plane = distance + 2 * scene_radius;
    return {glm::lookAt(target_world + distance * towards, target_world, glm::vec3(0, 1, 0)),
            glm::perspective(vertical_field_of_view_radians, aspect, near_plane, far_plane)};
}

OrbitCamera frame_head(const Bounds& bounds, float aspect) {
    OrbitCamera camera;
    const glm::vec3 size = bounds.empty() ? glm::vec3(0) : bounds.size();
    const float extent = std::max({size.x, size.y, size.z});
    if (!std::isfinite(extent) || !(extent > 0)) return camera;
    camera.target_world = bounds.centre();
    camera.scene_radius = 0.5F * glm::length(size);
    // The front of the box fills 1 / margin of the narrower side.
    constexpr float margin = 1.12F;
    const float half_tangent = std::tan(0.5F * camera.vertical_field_of_view_radians);
    const float half_height = 0.5F * margin * std::max(size.y, size.x / aspect);
    camera.distance = half_height / half_tangent + 0.5F * size.z;
    return camera;
}

}  // namespace blush
