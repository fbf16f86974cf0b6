#pragma once
/// What lights a frame, as data: a Scene without one has three lights of a portrait that follow the camera.

#include <cstdint>
#include <memory>
#include <vector>

#include "rig/face.h"
#include "rig/light/spherical_harmonics.h"
#include "rig/vectors.h"

namespace blush {

enum class LightKind : std::uint8_t { directional, point, spot };

struct LightSource {
    LightKind kind = LightKind::directional;
    DVec3 position_world{0};         ///< of a point or a spot
    Vec3 direction_world{0, 0, -1};  ///< the way it shines, any length above 0; of a directional light or a spot
    /// Irradiance on a facing surface / pi, so that white reflects this radiance; 0 or more. Of a point or a spot at
    /// `reference_distance`.
    Vec3 radiance_linear{1};
    float reference_distance = 1;  ///< world units, above 0
    float inner_radians = 0.4F;    ///< half angle of a spot's full light, below `outer_radians`
    float outer_radians = 0.5F;    ///< half angle of a spot's end, above 0 and below pi / 2
    bool casts_shadow = true;      ///< and shines through thin parts
    /// Goes round the upright axis through Lighting::orbit_centre_world once in so many seconds of
    /// ViewFrame::time_seconds, from where it stands at 0, past the face's front to its left (below 0: to its right).
    /// 0: it stands.
    float orbit_seconds = 0;
    /// Of what shines, for the width of its shadows' edges: radius of a point or
    /// a spot in world units, half the angle in radians that a directional light
    /// is seen under (below 0.5). 0 or more; 0: edges as sharp as the shadow
    /// map's.
    float size = 0;
};

/// A radiance map in equal longitudes and latitudes (rig/light/spherical_harmonics.h), prepared once.
struct Environment {
    Sh9Color radiance_sh{};  ///< of the map
    /// The map filtered for mirrors of roughness 0 to 1 in equal steps, rgb; level k is 2^k times smaller.
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<float> rgb_linear;
    };
    std::vector<Level> levels;
    std::uint64_t identity = 0;  ///< differs from environment to environment
};

/// Prepares a radiance map. What is not finite or is below 0 counts as 0. Error: an image without pixels.
Result<std::shared_ptr<const Environment>> make_environment(const Image& image);

struct Lighting {
    /// As many as a scene has. One that is dark, not finite or without a direction is left out; each character is lit
    /// by those that reach it (CharacterReport::lights).
    std::vector<LightSource> lights;
    Vec3 sky_radiance_linear{0}, ground_radiance_linear{0};  ///< ambient; not used with an environment
    std::shared_ptr<const Environment> environment;
    DVec3 orbit_centre_world{0};
    float environment_factor = 1, environment_turn_radians = 0;
};

}  // namespace blush
