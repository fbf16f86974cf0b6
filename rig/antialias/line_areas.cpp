// jimenez-2012: 9.4.3 (areas), 10.4.2 (patterns), 10.4.3 (offsets of subsamples).
//
// A pattern is taken for a polyline, and a weight is the area between the polyline and the edge within one pixel. The
// contour is known to pass the middle of each crossing edge; where both ends cross to opposite sides (Z) the line runs
// straight between those two points; where one end is open (L) or both cross to one side (U) it meets the edge halfway.

#include "rig/antialias/line_areas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace blush {
namespace {

using glm::dvec2;

/// Integral of max(f, 0) from x = 0 to width, where f is linear from `from` to `to`.
double positive_area(double from, double to, double width) {
    if (from <= 0 && to <= 0) return 0;
    if (from >= 0 && to >= 0) return (from + to) / 2 * width;
    const double high = std::max(from, to), low = std::min(from, to);
    return high / 2 * width * high / (high - low);
}

/// The same of min(f, 1).
double unit_area(double from, double to, double width) {
    return positive_area(from, to, width) - positive_area(from - 1, to - 1, width);
}

/// Adds the areas of a line within the pixels of column [column, column + 1]; y grows downwards, the edge is y = 0.
void add_segment(dvec2 from, dvec2 to, double column, PixelAreas& areas) {
    const double left = std::max(from.x, column), right = std::min(to.x, column + 1);
    if (right <= left) return;
    const auto height = [&](double x) { return glm::mix(from.y, to.y, (x - from.x) / (to.x - from.x)); };
    areas.near += unit_area(height(left), height(right), right - left);
    areas.far += unit_area(-height(left), -height(right), right - left);
}

/// -1: the contour leaves upwards, +1 downwards, 0: unknown.
int side_of(Crossing crossing) {
    if (crossing == Crossing::far) return -1;
    return crossing == Crossing::near ? 1 : 0;
}

PixelAreas smoothed(PixelAreas areas, int length) {
    constexpr double smooth_length_pixels = 32;
    const double kept = std::min(length / smooth_length_pixels, 1.0);
    const auto smooth = [&](double area) { return glm::mix(std::sqrt(2 * area) / 2, area, kept); };
    return {smooth(areas.near), smooth(areas.far)};
}

/// Height of an end on the middle line of a staircase, measured down from it, pixels.
double height_of(DiagonalEnd end, double along) {
    if (end == DiagonalEnd::along) return along;
    return end == DiagonalEnd::across ? -along : 0;
}

}  // namespace

PixelAreas orthogonal_areas(Crossing left_crossing, Crossing right_crossing, int left, int right, double line_offset,
                            Smoothing smoothing) {
    int left_side = side_of(left_crossing), right_side = side_of(right_crossing);
    // Where an end crosses to both sides, Z is likelier than U: it makes the longer contour (Reshetov 2009).
    if (left_crossing == Crossing::both) left_side = -right_side;
    if (right_crossing == Crossing::both) right_side = -side_of(left_crossing);

    PixelAreas areas;
    const double length = left + 1 + right;
    const dvec2 start(0, 0.5 * left_side + line_offset), end(length, 0.5 * right_side + line_offset);
    if (left_side != 0 && left_side == -right_side) {
        add_segment(start, end, left, areas);
        return areas;
    }
    const dvec2 middle(length / 2, 0);
    if (left_side != 0) add_segment(start, middle, left, areas);
    if (right_side != 0) add_segment(middle, end, left, areas);
    const bool bump = left_side != 0 && left_side == right_side;
    return bump && smoothing == Smoothing::short_bumps ? smoothed(areas, left + 1 + right) : areas;
}

PixelAreas diagonal_areas(DiagonalEnd lower_end, DiagonalEnd upper_end, int lower, int upper, double line_offset) {
    // The middle line of a staircase passes the middles of its edges: here y = 0.5 - x. An end that goes straight on is
    // a longer edge, whose middle is the last vertex of the staircase, half a pixel above or below the middle line.
    const double start_x = -lower, end_x = upper + 1;
    const double start_height = height_of(lower_end, -0.5), end_height = height_of(upper_end, 0.5);
    const bool straight = start_height * end_height < 0;
    const double middle_x = (start_x + end_x) / 2;
    const auto height = [&](double x) {  // beyond its ends the line goes on as it was, for offsets
        if (straight) return glm::mix(start_height, end_height, (x - start_x) / (end_x - start_x));
        return x < middle_x ? start_height * (middle_x - x) / (middle_x - start_x)
                            : end_height * (x - middle_x) / (end_x - middle_x);
    };
    const auto point = [&](double x) { return dvec2(x + line_offset, 0.5 - x + height(x) + line_offset); };
    PixelAreas areas;
    const double margin = 1;  // more than any offset
    add_segment(point(start_x - margin), point(middle_x), 0, areas);
    add_segment(point(middle_x), point(end_x + margin), 0, areas);
    return areas;
}

}  // namespace blush
