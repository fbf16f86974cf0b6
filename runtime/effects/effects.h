#pragma once
/// The effects by name, for their own files, for bakers and for tests: a frame walks effects().

#include "runtime/frame/effect.h"

namespace blush {

extern const Effect pinning_effect;
extern const Effect wrinkles_effect, blood_effect;
extern const Effect deformation_effect, normals_effect, skinning_effect, velocities_effect, multisampling_effect,
    antialiasing_effect, supersampling_effect, reprojection_effect;
extern const Effect parts_effect, depth_of_field_effect, bloom_effect, exposure_effect, film_grain_effect;
extern const Effect shadows_effect, translucency_effect, reflection_effect, environment_effect, occlusion_effect,
    scattering_effect, host_shadows_effect, probes_effect;

}  // namespace blush
