#pragma once
/// Wrinkle maps on disk: wrinkles.png (partial derivatives in red and green; 128 is 0, 1 and 255 the ends of the
/// range), wrinkle_mask_1.png, _2 and _3 (four zones each, in red, green, blue and alpha; as many as there are zones
/// for), and wrinkles.json, which says what they hold and, by "layout_from" and "layout_to", which part of the layout
/// they show. An artist may paint any of them over. No GL. Nothing here
/// throws; a message names file, place and reason.

#include <filesystem>
#include <string>
#include <vector>

#include "rig/map.h"
#include "rig/result.h"
#include "rig/wrinkles/derivative_map.h"
#include "rig/wrinkles/layout_part.h"

namespace blush {

/// An RGBA mask holds four zones (jimenez-2012, 8.2, which has two such masks).
inline constexpr std::size_t zones_a_wrinkle_mask = 4, most_wrinkle_masks = 3;
inline constexpr std::size_t most_wrinkle_zones = zones_a_wrinkle_mask * most_wrinkle_masks;
/// Masks that so many zones need.
constexpr std::size_t wrinkle_masks_for(std::size_t zones) {
    return (zones + zones_a_wrinkle_mask - 1) / zones_a_wrinkle_mask;
}

struct WrinkleSet {
    std::vector<std::string> zones;            ///< names as in Rig::wrinkle_zones(), no more than most_wrinkle_zones
    DerivativeMap derivatives;                 ///< within +-range
    std::vector<ScalarMap> masks;              ///< one a zone, of one size, 0 to 1
    float range = published_derivative_range;  ///< above 0, to largest_derivative_range
    /// What of the face's layout the maps show. Of a part, the outermost texels of masks are 0: no fold lies outside.
    LayoutPart part;
};

/// 89.4 degrees; beyond it one step of 8 bits is most of the useful range.
inline constexpr float largest_derivative_range = 100;

/// Into a folder that exists. Error: more than most_wrinkle_zones, or a file that cannot be written.
Status write_wrinkles(const std::filesystem::path& folder, const WrinkleSet& wrinkles);

/// Of 8 or 16 bits, or floating point (.exr is looked for where there is no .png; its values are plain derivatives and
/// weights). Texels that are not finite count as flat and as outside of every zone. Error: a map that is missing, has
/// too few channels or more than 8,192 texels a side; masks of two sizes; unknown keys; a range or a part out of its
/// bounds.
Result<WrinkleSet> load_wrinkles(const std::filesystem::path& folder);

}  // namespace blush
