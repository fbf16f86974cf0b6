#pragma once
/// The lights of one frame: the view's own or the portrait's, in the shader's terms.

#include <span>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/view.h"

namespace blush {

/// Three-point lighting of a portrait, fixed to the camera: a warm key from the upper left, a cool weak fill from the
/// right, a rim from behind. Radiances in units of the white that exposure 1 shows a little below display white.
Lighting portrait_lighting(const Camera& camera);

/// Lights that take part: no dark ones, none that is not finite, at most BLUSH_MOST_LIGHTS. `out` keeps its memory.
void usable_lights(const Lighting& lighting, double time_seconds, std::vector<LightSource>& out);

/// A light as the shader reads it, without a shadow map.
shared::Light shader_light(const LightSource& light);

/// Gives `light` the place of shadow map `index`, which looks at the sphere around `bounds`. Without effect where the
/// light stands inside that sphere, or nearly so: one map cannot look all around.
bool place_shadow_map(const LightSource& source, const Bounds& bounds, std::uint32_t side_texels, std::uint32_t index,
                      shared::Light& light);

}  // namespace blush
