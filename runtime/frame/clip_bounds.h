#pragma once
/// Bounds as the camera sees them.

#include <algorithm>
#include <array>

#include <glm/glm.hpp>

#include "rig/controls/head_and_eyes.h"

namespace blush {

/// The bounds' corners in clip space.
inline std::array<glm::vec4, 8> clip_corners(const glm::mat4& clip_from_mesh, const Bounds& bounds) {
    std::array<glm::vec4, 8> result{};
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) != 0 ? bounds.high.x : bounds.low.x, (i & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (i & 4) != 0 ? bounds.high.z : bounds.low.z);
        result[i] = clip_from_mesh * glm::vec4(corner, 1);
    }
    return result;
}

/// Whether all corners are beyond one and the same side of the view made larger by `margin`, of its half width and
/// height.
inline bool outside_view(const std::array<glm::vec4, 8>& clip, glm::vec2 margin = glm::vec2(0)) {
    const glm::vec3 sides(1.0F + margin, 1);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            const auto beyond = [&](const glm::vec4& c) { return sign * c[axis] > sides[axis] * c.w; };
            if (std::ranges::all_of(clip, beyond)) return true;
        }
    }
    return false;
}

}  // namespace blush
