// jimenez-2012, 9.4: searches that take two pixels a step and look at the line's own edges alone.

#include <algorithm>
#include <cmath>

#include "rig/antialias/edge_frame.h"
#include "rig/antialias/mlaa_table.h"
#include "rig/antialias/weights.h"

namespace blush {
namespace {

/// Listing 9.3. Of a pair with one edge only, the search cannot tell which it is, and counts one pixel.
int find_distance(const EdgeFrame& frame, int direction, int search_steps) {
    for (int step = 0; step < search_steps; ++step) {
        const int found =
            (frame.upper(direction * (2 * step + 1), 0) ? 1 : 0) + (frame.upper(direction * (2 * step + 2), 0) ? 1 : 0);
        if (found < 2) return 2 * step + found;
    }
    return 2 * search_steps;
}

/// Listing 9.2, for one edge.
glm::u8vec2 areas_of(const EdgeFrame& frame, int search_steps) {
    const int left = find_distance(frame, -1, search_steps), right = find_distance(frame, 1, search_steps);
    const auto code = [&](int i) { return (frame.left(i, -1) ? 1 : 0) + (frame.left(i, 0) ? 3 : 0); };
    return mlaa_areas().at(mlaa_distances * code(-left) + left, mlaa_distances * code(right + 1) + right);
}

}  // namespace

const AreaImage& mlaa_areas() {
    static const AreaImage image = [] {
        constexpr int side = 5 * mlaa_distances;
        AreaImage made{side, side, std::vector<std::uint8_t>(std::size_t{2} * side * side)};
        const auto distance = [](int i) { return i % mlaa_distances; };
        const auto crossing = [](int i) { return static_cast<Crossing>(i / mlaa_distances); };
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if (x / mlaa_distances == 2 || y / mlaa_distances == 2) continue;  // a code that cannot occur
                const PixelAreas areas =
                    orthogonal_areas(crossing(x), crossing(y), distance(x), distance(y), 0, Smoothing::none);
                const auto i = static_cast<std::size_t>(2 * (y * side + x));
                made.near_far[i] = static_cast<std::uint8_t>(std::lround(255 * areas.near));
                made.near_far[i + 1] = static_cast<std::uint8_t>(std::lround(255 * areas.far));
            }
        }
        return made;
    }();
    return image;
}

WeightMap mlaa_weights(const EdgeMap& edges, const MlaaSettings& settings) {
    const int steps = std::min(settings.search_steps, largest_mlaa_search_steps);
    WeightMap weights(edges.width, edges.height);
    for (int y = 0; y < edges.height; ++y) {
        for (int x = 0; x < edges.width; ++x) {
            glm::u8vec2 upper(0), left(0);
            if (edges.upper(x, y)) upper = areas_of(EdgeFrame::horizontal(edges, x, y), steps);
            if (edges.left(x, y)) left = areas_of(EdgeFrame::vertical(edges, x, y), steps);
            weights.at(x, y) = {upper.x, upper.y, left.x, left.y};
        }
    }
    return weights;
}

}  // namespace blush
