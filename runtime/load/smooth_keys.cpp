#include "runtime/load/smooth_keys.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace blush {
namespace {

/// The weighted harmonic mean of the slopes on both sides; level where they do not rise or fall together.
double monotone_slope(double step_before, double slope_before, double step_after, double slope_after) {
    if (!((slope_before > 0 && slope_after > 0) || (slope_before < 0 && slope_after < 0))) return 0;
    const double weight_before = 2 * step_after + step_before, weight_after = step_after + 2 * step_before;
    return (weight_before + weight_after) / (weight_before / slope_before + weight_after / slope_after);
}

}  // namespace

Track smooth_track(const Track& linear) {
    const std::size_t count = linear.times_seconds.size();
    const auto time = [&](std::size_t i) { return static_cast<double>(linear.times_seconds[i]); };
    const auto value = [&](std::size_t i) { return static_cast<double>(linear.values[i]); };
    Track track{
        .interpolation = Interpolation::cubic_spline, .width = 1, .times_seconds = linear.times_seconds, .values = {}};
    track.values.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        double slope = 0;
        if (i > 0 && i + 1 < count) {
            const double before = time(i) - time(i - 1), after = time(i + 1) - time(i);
            slope =
                monotone_slope(before, (value(i) - value(i - 1)) / before, after, (value(i + 1) - value(i)) / after);
        }
        // Steep enough to leave a float's range only between keys of absurd size; a clamped slope is still monotone.
        constexpr double limit = static_cast<double>(std::numeric_limits<float>::max());
        const float tangent = static_cast<float>(std::clamp(slope, -limit, limit));
        track.values.insert(track.values.end(), {tangent, linear.values[i], tangent});
    }
    return track;
}

}  // namespace blush
