/// This program's registry, in the place of the library's: the shading effects of the library, and one more.

#include <array>

#include "runtime/effects/effects.h"
#include "tests/added_effect/frost.h"

namespace blush {

std::span<const Effect* const> effects() {
    static constexpr std::array all = {
        &deformation_effect,   &normals_effect,      &skinning_effect,      &wrinkles_effect,     &blood_effect,
        &frost_effect,         &shadows_effect,      &translucency_effect,  &reflection_effect,   &environment_effect,
        &occlusion_effect,     &parts_effect,        &scattering_effect,    &exposure_effect,     &velocities_effect,
        &multisampling_effect, &antialiasing_effect, &supersampling_effect, &reprojection_effect,
    };
    return all;
}

}  // namespace blush
