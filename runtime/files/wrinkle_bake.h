#pragma once
/// Wrinkle maps for a face out of its own expressions, ready to be drawn or written. No GL, no file.

#include <cstdint>

#include "rig/controls/rig.h"
#include "rig/wrinkles/wrinkle_maps.h"
#include "runtime/files/wrinkle_file.h"

namespace blush {

struct WrinkleBakeOptions {
    WrinkleBake maps;               ///< its millimetres_a_unit does not count
    float range = 0;                ///< derivative that 8 bits end at; 0: as far as the steepest fold goes, between
                                    ///< published_derivative_range and widest_chosen_range
    double millimetres_a_unit = 0;  ///< 0: by the distance of the pupils
    bool whole_layout = false;      ///< maps of the whole texture layout, not of the part that folds
};
/// 76 degrees: folds of skin that are steeper are mistakes.
inline constexpr float widest_chosen_range = 4;

struct BakedWrinkles {
    WrinkleSet set;
    ScalarMap displacement_mm;
    std::size_t poses = 0;
    double millimetres_a_unit = 0, steepest_degrees = 0;
    std::size_t saturated_texels = 0;      ///< steeper than the range, and held to it
    std::uint32_t overlapping_texels = 0;  ///< used by more than one triangle
    std::vector<std::string> empty_zones;  ///< that no expression presses together
};

/// Error: a face on which nothing tells skin from the rest, or the scale, or which no expression wrinkles; more zones
/// than masks hold.
Result<BakedWrinkles> bake_wrinkle_set(const Face& face, const WrinkleBakeOptions& options = {});

/// Bytes of a set on the GPU, compressed (RGTC2 map, RGBA masks): as the thesis counts them (8.3), and the mip levels
/// of the map, which it does not mention.
struct WrinkleBytes {
    std::uint64_t map = 0, masks = 0, mip_levels = 0, uncompressed_map = 0;
};
WrinkleBytes wrinkle_bytes(const WrinkleSet& set);

}  // namespace blush
