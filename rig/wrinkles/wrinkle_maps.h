#pragma once
/// Wrinkle maps for any face with targets, out of how its own expressions press the skin together (jimenez-2012,
/// chapter 8, has them painted by an artist; where they go, and how strongly, follows here from the strain of the
/// surface).

#include <cstdint>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/wrinkles/derivative_map.h"
#include "rig/wrinkles/uv_raster.h"
#include "rig/wrinkles/wrinkle_zones.h"

namespace blush {

/// A pose that wrinkles the skin.
struct WrinkleSource {
    std::vector<float> target_weights;  ///< one for each target of the face
    std::vector<float> zone_weights;    ///< one for each zone: how strongly the rig wrinkles it in this pose; only what
                                        ///< is above 0 counts
};

struct WrinkleBake {
    std::uint32_t map_side = 256, mask_side = 64;  ///< texels (jimenez-2012, 8.3)
    float millimetres_a_unit = 1000;               ///< of the mesh; glTF's unit is the metre
    float spacing_mm = 8;                          ///< from fold to fold; no finer than four texels. Forehead
                                                   ///< furrows stand 6 to 12 mm apart (by eye)
    std::uint32_t seed = 1;
    std::uint32_t uv_set = 0;
};

struct WrinkleMaps {
    UvRaster raster;               ///< of the wrinkle map
    ScalarMap displacement_mm;     ///< along the normal, at full strength of every zone
    DerivativeMap derivatives;     ///< of the displacement, in the face's own tangent space
    std::vector<ScalarMap> masks;  ///< of each zone: mask_side x mask_side, 0 to 1; together no more than 1
};

/// skin: one entry for each primitive, 0 leaves it out. sources: at least one; zones are counted by the first. A face
/// without texture coordinates or a zone that nothing presses together gives empty masks (all 0). places: of each zone,
/// where it may be, in maps of map_side x map_side texels; none at all: anywhere.
WrinkleMaps bake_wrinkles(const Face& face, std::span<const std::uint8_t> skin, std::span<const WrinkleSource> sources,
                          const WrinkleBake& settings, std::span<const WrinkleZoneField> places = {});

}  // namespace blush
