#pragma once
/// How far the combined normals of wrinkle maps are from those of the surface that they stand for: a curved patch of
/// skin, displaced by pores and folds and differentiated in double precision.

#include <cstdint>
#include <string_view>

namespace blush {

/// How wrinkles are stored and added to the base normal map.
enum class WrinkleEncoding : std::uint8_t {
    derivatives,  ///< partial derivatives, added up (jimenez-2012, 8.2)
    differences,  ///< differences of normals, added and normalised (8.2.1)
};

struct WrinkleErrorCase {
    WrinkleEncoding encoding = WrinkleEncoding::derivatives;
    double steepest_degrees = 30;                   ///< tilt of the flanks of the folds alone, below 90
    double weight = 1;                              ///< of the wrinkles; negative ones turn valleys into ridges
    bool eight_bits = true;                         ///< stored in 8 bits; otherwise in single precision
    float range = 1;                                ///< of stored derivatives
    std::uint32_t map_side = 256, base_side = 512;  ///< texels of the wrinkle map and of the base map
};

struct NormalError {
    double mean_degrees = 0, percentile99_degrees = 0, worst_degrees = 0;
};

/// Over a patch of 60 x 60 mm of a sphere of 90 mm radius (a forehead), pores of 0.02 mm every 1.3 mm in the base map,
/// folds every 8 mm in the wrinkle map; both maps looked up with bilinear filtering at points between their texels.
NormalError wrinkle_normal_error(const WrinkleErrorCase& of);

}  // namespace blush
