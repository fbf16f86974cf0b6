#include <array>

#include "runtime/effects/effects.h"

namespace blush {

std::span<const Effect* const> effects() {
    static const std::array all = {
        &deformation_effect,  &normals_effect,       &skinning_effect,     &pinning_effect,
        &wrinkles_effect,     &blood_effect,         &shadows_effect,      &translucency_effect,
        &host_shadows_effect, &reflection_effect,    &environment_effect,  &probes_effect,
        &occlusion_effect,    &parts_effect,         &scattering_effect,   &depth_of_field_effect,
        &bloom_effect,        &exposure_effect,      &velocities_effect,   &multisampling_effect,
        &antialiasing_effect, &supersampling_effect, &reprojection_effect, &film_grain_effect,
    };
    return all;
}

}  // namespace blush
