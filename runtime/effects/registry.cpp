#include <array>

#include "runtime/frame/effect.h"

namespace blush {

std::span<const Effect* const> effects() {
    static const std::array all = {
        &deformation_effect,    &normals_effect,       &skinning_effect,          &pinning_effect,
        &wrinkle_baking_effect, &wrinkles_effect,      &appearance_baking_effect, &blood_effect,
        &shadows_effect,        &translucency_effect,  &reflection_effect,        &environment_effect,
        &occlusion_effect,      &parts_effect,         &scattering_effect,        &depth_of_field_effect,
        &bloom_effect,          &exposure_effect,      &velocities_effect,        &multisampling_effect,
        &antialiasing_effect,   &supersampling_effect, &reprojection_effect,      &film_grain_effect,
    };
    return all;
}

bool is_hidden(const EffectSettings& settings, std::string_view effect) {
    return settings.choice(effect, "shown") == 1;
}

}  // namespace blush
