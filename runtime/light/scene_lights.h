#pragma once
/// The lights of one frame: the scene's own or the portrait's, and what of them reaches a character, in the shader's
/// terms.

#include <optional>
#include <span>
#include <vector>

#include "runtime/gl/shared_blocks.h"
#include "runtime/view.h"

namespace blush {

/// Three-point lighting of a portrait, fixed to the camera: a warm key from the upper left, a cool weak fill from the
/// right, a rim from behind. Radiances in units of the white that exposure 1 shows a little below display white.
/// `out` keeps its memory.
void portrait_lighting(const Camera& camera, Lighting& out);

/// Lights that take part: no dark ones, none that is not finite. `out` keeps its memory.
void usable_lights(const Lighting& lighting, double time_seconds, std::vector<LightSource>& out);

/// A light from which white reflects less than this anywhere on a character is left out: a twentieth of the smallest
/// step of 8 bits at the dark end of sRGB, 1 / (255 * 12.92).
inline constexpr double weakest_radiance = 1.5e-5;

struct LightsThatReach {
    std::uint32_t left_out = 0;
    double left_out_radiance = 0;  ///< that white would reflect of them, at most: the bound of the omission
};

/// Finds those of `lights` that reach a sphere: the strongest BLUSH_MOST_LIGHTS, by index in `out`, ascending.
LightsThatReach lights_that_reach(std::span<const LightSource> lights, glm::dvec3 centre, double radius,
                                  std::vector<std::uint32_t>& out);

/// A light as the shader reads it, without a shadow map.
shared::Light shader_light(const LightSource& light, glm::dvec3 origin_world);

/// Where the map of one light for one character looks.
struct ShadowPlace {
    glm::dmat4 shadow_from_world{1};  ///< clip space of the map
    float near_distance = 0, far_distance = 1;
    float extent = 1;      ///< width of what the map shows, world units; of a perspective at a distance of 1
    float light_size = 0;  ///< shared::Light::shadow_depth.z
    bool perspective = false;

    bool operator==(const ShadowPlace&) const = default;
};

/// A map that looks at a sphere, from before all that stands up to `nearer_casters` nearer to the light than the
/// sphere. Nothing where the light stands inside the sphere, or nearly so: one map cannot look all around.
std::optional<ShadowPlace> place_shadow_map(const LightSource& source, glm::dvec3 centre, double radius,
                                            double nearer_casters);

/// A square of the texture of all maps, texels.
struct ShadowTile {
    std::uint32_t x = 0, y = 0, side = 0;
};

/// Gives `light` its map.
void write_shadow(const ShadowPlace& place, const ShadowTile& tile, glm::dvec3 origin_world, shared::Light& light);

}  // namespace blush
