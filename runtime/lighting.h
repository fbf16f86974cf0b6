#pragma once
/// What lights a frame, as data: a Scene without one has three lights of a portrait that follow the camera.

#include <cstdint>
#include <memory>
#include <vector>

#include "rig/face.h"
#include "rig/light/spherical_harmonics.h"
#include "rig/vectors.h"
#include "runtime/depth_convention.h"

namespace blush {

enum class LightKind : std::uint8_t { directional, point, spot };

/// A shadow map of the host's own, which hides a light from the characters as it does from the host's world.
struct HostShadow {
    /// GL name of a 2D depth texture of one sample, alive while drawing, its base level the map; 0: none. What it is
    /// sampled with does not matter.
    std::uint32_t depth_texture = 0;
    DMat4 clip_from_world{1};
    DepthConvention depth_convention;  ///< of clip_from_world and of the texture
    /// How far off its surface a character looks, beyond a texel of the map, world units: with the characters
    /// themselves in the map, some millimetres.
    float bias = 0;
};

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
    HostShadow
        host_shadow;  ///< besides the shadows that characters cast; of the four lights a character that come first
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

/// Light from all around at one place, such as a host's light probe.
struct LightProbe {
    DVec3 position_world{0};
    double reach = 1;        ///< world units, above 0: from here on it lights nothing
    Sh9Color radiance_sh{};  ///< of the radiance that arrives
};

struct Lighting {
    /// As many as a scene has. One that is dark, not finite or without a direction is left out; each character is lit
    /// by those that reach it (CharacterReport::lights).
    std::vector<LightSource> lights;
    Vec3 sky_radiance_linear{0}, ground_radiance_linear{0};  ///< ambient; not used with an environment
    std::shared_ptr<const Environment> environment;
    /// As many as a scene has. Each character is lit by those that reach its middle, the nearer the more; what share
    /// they leave is the environment's, or sky's and ground's. One that is not finite or has no reach is left out.
    std::vector<LightProbe> probes;
    DVec3 orbit_centre_world{0};
    float environment_factor = 1, environment_turn_radians = 0;
};

}  // namespace blush
