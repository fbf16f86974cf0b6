// jimenez-2012, 10.4.2: diagonal patterns first, orthogonal ones where there is none.

#include <cmath>
#include <optional>

#include "rig/antialias/edge_frame.h"
#include "rig/antialias/smaa_tables.h"
#include "rig/antialias/weights.h"

namespace blush {
namespace {

/// An end of a line: pixels from the one that is asked about, and what crosses there.
struct LineEnd {
    int distance = 0;
    Crossing crossing = Crossing::none;
    bool far_corner = false, near_corner = false;  ///< the crossing edge is two pixels long (figure 10.6, orange)
};

Crossing crossing_of(bool far, bool near) { return static_cast<Crossing>((far ? 1 : 0) + (near ? 3 : 0)); }

/// Accurate distance search (figure 10.9): along the edges until they end or another edge crosses.
LineEnd find_end(const EdgeFrame& frame, int direction, int search_steps) {
    LineEnd end;
    const int reach = 2 * search_steps - 1;
    // The boundary behind pixel i is the left one of pixel i, or of its right neighbour.
    const auto boundary = [&] { return direction * end.distance + (direction > 0 ? 1 : 0); };
    const auto crossed = [&] { return frame.left(boundary(), 0) || frame.left(boundary(), -1); };
    while (end.distance < reach && !crossed() && frame.upper(direction * (end.distance + 1), 0)) ++end.distance;
    end.crossing = crossing_of(frame.left(boundary(), -1), frame.left(boundary(), 0));
    end.far_corner = frame.left(boundary(), -2);
    end.near_corner = frame.left(boundary(), 1);
    return end;
}

/// (10.2) and (10.3). As printed, at equal distances the right end decides alone; here both share, so that a mirrored
/// picture gives mirrored weights.
float rounding_factor(int left, int right, bool left_corner, bool right_corner, float rounding) {
    const float left_share = left < right ? 1.0F : left == right ? 0.5F : 0.0F;
    const float corners = (left_corner ? left_share : 0.0F) + (right_corner ? 1 - left_share : 0.0F);
    return 1 - (1 - rounding) * corners;
}

glm::u8vec2 orthogonal_weights(const EdgeFrame& frame, const SmaaSettings& settings, int slice) {
    const LineEnd left = find_end(frame, -1, settings.search_steps), right = find_end(frame, 1, settings.search_steps);
    const glm::u8vec2 areas = smaa_areas().orthogonal.at(
        orthogonal_distances * static_cast<int>(left.crossing) + left.distance,
        orthogonal_slice_side * slice + orthogonal_distances * static_cast<int>(right.crossing) + right.distance);
    const auto rounded = [&](std::uint8_t area, bool left_corner, bool right_corner) {
        const float factor =
            rounding_factor(left.distance, right.distance, left_corner, right_corner, settings.corner_rounding);
        return static_cast<std::uint8_t>(std::floor(static_cast<float>(area) * factor + 0.5F));
    };
    return {rounded(areas.x, left.near_corner, right.near_corner), rounded(areas.y, left.far_corner, right.far_corner)};
}

struct Staircase {
    int lower = 0, upper = 0;  ///< whole steps to both sides
    DiagonalEnd lower_end = DiagonalEnd::open, upper_end = DiagonalEnd::open;
    int edges = 1;
};

/// Follows the staircase that climbs to the upper right, both ways.
Staircase find_staircase(const EdgeFrame& frame, int search_steps) {
    Staircase stairs;
    while (stairs.upper < search_steps) {
        const int k = stairs.upper;
        if (!frame.left(k + 1, -k - 1)) {
            if (frame.upper(k + 1, -k)) stairs.upper_end = DiagonalEnd::along;
            break;
        }
        ++stairs.edges;
        if (!frame.upper(k + 1, -k - 1)) {
            if (frame.left(k + 1, -k - 2)) stairs.upper_end = DiagonalEnd::across;
            break;
        }
        ++stairs.edges;
        ++stairs.upper;
    }
    while (stairs.lower < search_steps) {
        const int k = stairs.lower;
        if (!frame.left(-k, k)) {
            if (frame.upper(-k - 1, k)) stairs.lower_end = DiagonalEnd::along;
            break;
        }
        ++stairs.edges;
        if (!frame.upper(-k - 1, k + 1)) {
            if (frame.left(-k, k + 1)) stairs.lower_end = DiagonalEnd::across;
            break;
        }
        ++stairs.edges;
        ++stairs.lower;
    }
    return stairs;
}

/// Of the one staircase that the edge belongs to: near is the pixel (0, 0) of the frame. Nothing where there is none,
/// or where two meet.
std::optional<glm::u8vec2> diagonal_weights(const EdgeFrame& frame, const EdgeFrame& mirrored, int search_steps,
                                            int slice, int mirrored_slice, bool swap_mirrored) {
    if (search_steps == 0) return std::nullopt;
    const Staircase up = find_staircase(frame, search_steps), down = find_staircase(mirrored, search_steps);
    const bool is_up = up.edges >= fewest_diagonal_edges, is_down = down.edges >= fewest_diagonal_edges;
    if (is_up == is_down) return std::nullopt;
    const Staircase& stairs = is_up ? up : down;
    const glm::u8vec2 areas =
        smaa_areas().diagonal.at(diagonal_distances * static_cast<int>(stairs.lower_end) + stairs.lower,
                                 diagonal_slice_side * (is_up ? slice : mirrored_slice) +
                                     diagonal_distances * static_cast<int>(stairs.upper_end) + stairs.upper);
    return is_down && swap_mirrored ? glm::u8vec2(areas.y, areas.x) : areas;
}

}  // namespace

WeightMap smaa_weights(const EdgeMap& edges, const SmaaSettings& settings, SubsampleSlices slices) {
    WeightMap weights(edges.width, edges.height);
    const int diagonal_steps = settings.diagonal_search_steps;
    for (int y = 0; y < edges.height; ++y) {
        for (int x = 0; x < edges.width; ++x) {
            glm::u8vec2 upper(0), left(0);
            if (edges.upper(x, y)) {
                const EdgeFrame frame = EdgeFrame::horizontal(edges, x, y);
                const auto diagonal = diagonal_weights(frame, EdgeFrame::horizontal_mirrored(edges, x, y),
                                                       diagonal_steps, slices.z, slices.w, false);
                upper = diagonal ? *diagonal : orthogonal_weights(frame, settings, slices.x);
            }
            if (edges.left(x, y)) {
                const EdgeFrame frame = EdgeFrame::vertical(edges, x, y);
                const auto diagonal = diagonal_weights(frame, EdgeFrame::vertical_mirrored(edges, x, y), diagonal_steps,
                                                       slices.z, slices.w, true);
                left = diagonal ? *diagonal : orthogonal_weights(frame, settings, slices.y);
            }
            weights.at(x, y) = {upper.x, upper.y, left.x, left.y};
        }
    }
    return weights;
}

}  // namespace blush
