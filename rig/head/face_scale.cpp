#include "rig/head/face_scale.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/head/canonical_face.h"
#include "rig/head/skin_material.h"

namespace blush {
namespace {

/// Length in the world of a unit of the mesh that a primitive belongs to.
double world_units_a_mesh_unit(const Face& face, std::uint32_t primitive) {
    const std::vector<glm::dmat4> world = rest_placement(face);
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh != static_cast<std::int32_t>(face.primitives[primitive].mesh)) continue;
        const double volume = std::abs(glm::determinant(glm::dmat3(world[n])));
        return std::cbrt(volume);
    }
    return 1;
}

/// 0 where the targets do not tell.
double millimetres_by_pupils(const Face& face) {
    const std::vector<std::uint32_t> skin = skin_primitives(face);
    if (skin.empty()) return 0;
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(face, skin);
    if (!landmarks) return 0;
    const double apart = glm::distance(glm::dvec3(landmarks->left_eye), glm::dvec3(landmarks->right_eye)) *
                         world_units_a_mesh_unit(face, skin[0]);
    const double scale = 2 * static_cast<double>(canonical_pupil_mm) / apart;
    return std::isfinite(scale) ? scale : 0;
}

}  // namespace

FaceScale face_scale(const Face& face) {
    const Bounds bounds = moving_bounds(face);
    const double by_extent = millimetres_a_unit(bounds);
    if (bounds.empty()) return {by_extent, "it has no vertices"};
    const glm::dvec3 size(bounds.size());
    const double extent = std::max({size.x, size.y, size.z});
    if (extent >= 0.15 && extent <= 0.6) return {by_extent, "its largest extent is that of a head in metres", false};
    constexpr double smallest = 1e-9, largest = 1e9;
    if (const double scale = millimetres_by_pupils(face); scale > 0)
        return {std::clamp(scale, smallest, largest), "its pupils are taken as 62 mm apart", false};
    constexpr double shoulders_mm = 450;
    // A head with its neck is 0.6 to 0.8 as wide as tall.
    if (extent > 1e-9 && std::isfinite(extent) && size.x > 0.95 * size.y && size.x >= size.z) {
        return {std::clamp(shoulders_mm / size.x, smallest, largest),
                "it is as wide as tall: a bust, whose shoulders are taken as 450 "
                "mm wide"};
    }
    return {by_extent, "its largest extent is taken as a head of 240 mm"};
}

}  // namespace blush
