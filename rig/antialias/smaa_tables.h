#pragma once
/// SMAA's precomputed tables (jimenez-2012, 10.4.2; figures 10.3c, 10.8): areas of every pattern, and how far a search
/// got by the value that its last bilinear fetch gave.
///
/// The filter itself reads areas at every whole distance. The published layout, which other programs' shaders expect,
/// holds distances 0, 1, 4, 9, ... of orthogonal lines and is read by interpolating at their square root: smaller, but
/// up to 0.10 of a pixel off the areas (tests/rig/antialias/smaa_tables.cpp), so it is only written, by
/// `blush bake smaa-tables`.

#include <array>
#include <cstdint>
#include <vector>

#include "rig/antialias/line_areas.h"
#include "rig/vectors.h"

namespace blush {

/// Offsets of subsamples that the table has a slice for, pixels. SMAA S2x and T2x use +-0.25, 4x all of them.
inline constexpr std::array<double, 7> subsample_offsets_pixels = {0, -0.25, 0.25, -0.125, 0.125, -0.375, 0.375};
inline constexpr int subsample_slice_count = 7;

/// Two channels of 8 bits, rows from the top: near and far (PixelAreas).
struct AreaImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> near_far;  ///< 2 * width * height

    U8Vec2 at(int x, int y) const {
        const auto i =
            2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {near_far[i], near_far[i + 1]};
    }
};

/// Sides of the table's blocks, texels: one a whole distance.
inline constexpr int orthogonal_distances = 64, diagonal_distances = 20;
inline constexpr int orthogonal_codes = 5, diagonal_codes = 4;
inline constexpr int orthogonal_slice_side = orthogonal_distances * orthogonal_codes;  ///< 320
inline constexpr int diagonal_slice_side = diagonal_distances * diagonal_codes;        ///< 80

/// What the filter reads. Slices stand below each other.
struct SmaaAreas {
    AreaImage orthogonal;  ///< 320 x 2240: x = 64 * left crossing + left, y = 320 * slice + 64 * right crossing + right
    AreaImage diagonal;    ///< 80 x 560: x = 20 * lower end + lower, y = 80 * slice + 20 * upper end + upper
};

/// Computed on the first call, in a few milliseconds; the same object every time.
const SmaaAreas& smaa_areas();

/// The published layout: 160 x 560; slices of 80 rows; on the left orthogonal blocks of 16 x 16, index i standing for
/// distance i * i; on the right diagonal blocks of 20 x 20.
AreaImage published_area_image();

/// Search table, 64 x 16, one channel of 8 bits, 127 a pixel. x: 32 times what the fetch gave of the crossing edges,
/// plus 33 for searches to the right or down; y: 32 less 32 times what it gave of the line's own edges. Cropped where
/// all is 0.
inline constexpr int search_table_width = 64, search_table_height = 16, search_table_right = 33;
const std::vector<std::uint8_t>& search_table();

/// How far the last fetch of a search reaches: 0 to 2 pixels of `near` (the pixel of the pair that is met first) and
/// `far`; left: one less, since its first pair includes the pixel where it starts.
/// crossing_near, crossing_far: is there a crossing edge at the left boundary of that pixel, in either row?
int last_step_length(bool to_the_right, bool edge_near, bool edge_far, bool crossing_near, bool crossing_far);

}  // namespace blush
