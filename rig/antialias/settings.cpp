#include "rig/antialias/settings.h"

#include <algorithm>
#include <cmath>

#include "rig/antialias/smaa_tables.h"

namespace blush {

SmaaSettings smaa_preset(SmaaPreset preset) {
    SmaaSettings settings;
    const auto set = [&](float threshold, int steps, int diagonal_steps, float corner_rounding) {
        settings.edges.threshold = threshold;
        settings.search_steps = steps;
        settings.diagonal_search_steps = diagonal_steps;
        settings.corner_rounding = corner_rounding;
    };
    switch (preset) {
        case SmaaPreset::low:
            set(0.15F, 4, 0, 1);
            break;
        case SmaaPreset::medium:
            set(0.1F, 8, 0, 1);
            break;
        case SmaaPreset::high:
            set(0.1F, 16, 8, 0.25F);
            break;
        case SmaaPreset::ultra:
            set(0.05F, 32, 16, 0.25F);
            break;
    }
    return settings;
}

SubsampleSlices subsample_slices(glm::vec2 offset_pixels) {
    const auto nearest = [](float offset) {
        const auto distance = [&](double candidate) { return std::abs(candidate - static_cast<double>(offset)); };
        const auto found = std::ranges::min_element(subsample_offsets_pixels, {}, distance);
        return static_cast<int>(found - subsample_offsets_pixels.begin());
    };
    // Across a line lies what shifts it: y for a horizontal one, half of x + y for a diagonal (x and y shift it alike).
    const float x = offset_pixels.x, y = offset_pixels.y;
    return {nearest(y), nearest(x), nearest((x + y) / 2), nearest((y - x) / 2)};
}

}  // namespace blush
