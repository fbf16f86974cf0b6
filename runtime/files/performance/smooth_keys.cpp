#include "runtime/files/performance/smooth_keys.h"

#include <algorithm>
#include <cmath>
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

/// Steep enough to leave a float's range only between keys of absurd size; a clamped slope is still monotone.
float limited(double slope) {
    constexpr double limit = static_cast<double>(std::numeric_limits<float>::max());
    return static_cast<float>(std::clamp(slope, -limit, limit));
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
        const float tangent = limited(slope);
        track.values.insert(track.values.end(), {tangent, linear.values[i], tangent});
    }
    return track;
}

Track eased_track(const Track& linear, std::span<const Ease> eases) {
    const bool all_alike = std::ranges::all_of(eases, [&](Ease ease) { return ease == eases.front(); });
    if (all_alike && eases.front() == Ease::linear) return linear;
    if (all_alike && eases.front() == Ease::step) {
        Track track = linear;
        track.interpolation = Interpolation::step;
        return track;
    }
    const Track smooth = smooth_track(linear);
    if (all_alike && eases.front() == Ease::smooth) return smooth;

    Track track{.interpolation = Interpolation::cubic_spline, .width = 1, .times_seconds = {}, .values = {}};
    const auto add_key = [&](float time, float in_tangent, float value, float out_tangent) {
        track.times_seconds.push_back(time);
        track.values.insert(track.values.end(), {in_tangent, value, out_tangent});
    };
    const std::size_t count = linear.times_seconds.size();
    float in_tangent = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float time = linear.times_seconds[i], value = linear.values[i];
        if (i + 1 == count) {
            add_key(time, in_tangent, value, 0);
            break;
        }
        const float next_time = linear.times_seconds[i + 1];
        if (eases[i] == Ease::step) {
            add_key(time, in_tangent, value, 0);
            // The value holds until the last float before the next key: no time lies between the two.
            const float last_moment = std::nextafter(next_time, time);
            if (last_moment > time) add_key(last_moment, 0, value, 0);
            in_tangent = 0;
        } else if (eases[i] == Ease::smooth) {
            add_key(time, in_tangent, value, smooth.values[3 * i + 2]);
            in_tangent = smooth.values[3 * (i + 1)];
        } else {
            const double slope = (static_cast<double>(linear.values[i + 1]) - static_cast<double>(value)) /
                                 (static_cast<double>(next_time) - static_cast<double>(time));
            const EaseSlopes slopes = slopes_of(eases[i]);
            add_key(time, in_tangent, value, limited(slopes.start * slope));
            in_tangent = limited(slopes.end * slope);
        }
    }
    return track;
}

}  // namespace blush
