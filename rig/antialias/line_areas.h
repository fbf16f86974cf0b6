#pragma once
/// The geometry behind the area tables: which share of a pixel lies beyond the line that a pattern of edges stands for.

#include <cstdint>

namespace blush {

/// Shares of the two pixels beside an edge that take the other's colour, 0 to 1.
struct PixelAreas {
    double near = 0;  ///< of the pixel below a horizontal edge (right of a vertical one), which owns the edge
    double far = 0;   ///< of the pixel above it (left of it)
};

/// What crosses the end of a line, as the bilinear fetch at a quarter of a pixel yields it, times four (jimenez-2012,
/// 9.4.2). 2 cannot occur.
enum class Crossing : std::uint8_t { none = 0, far = 1, near = 3, both = 4 };

/// Whether the areas of a U are raised towards sqrt(2 a) / 2 where it is shorter than 32 pixels: a bump of one or
/// two pixels is a feature cut by sampling more often than a slow curve, and would blink as it moves.
enum class Smoothing : std::uint8_t { none, short_bumps };

/// A horizontal line of left + 1 + right pixels, at the pixel with `left` others to its left (10.4.2 and 9.4.3).
/// line_offset: how far the samples stand below the pixel centres, pixels (10.4.3, figure 10.11).
PixelAreas orthogonal_areas(Crossing left_crossing, Crossing right_crossing, int left, int right, double line_offset,
                            Smoothing smoothing);

/// How a diagonal run of steps of one pixel goes on behind its last edge (figure 10.8).
enum class DiagonalEnd : std::uint8_t {
    open = 0,   ///< not straight on, or beyond the reach of the search
    along = 1,  ///< ends with an edge of the kind that is asked for, and goes straight on
    across = 2  ///< ends with an edge of the other kind, and goes straight on
};

/// A staircase towards the upper right, at a horizontal edge with `lower` whole steps before and `upper` after it.
/// line_offset: how far the samples stand from the centres along (1, 1), pixels right and down.
PixelAreas diagonal_areas(DiagonalEnd lower_end, DiagonalEnd upper_end, int lower, int upper, double line_offset);

}  // namespace blush
