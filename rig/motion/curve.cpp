/// glTF 2.0, appendix C (animation sampler interpolation modes). Arithmetic is in double so that no pair of finite
/// float times, values or tangents can overflow on the way; the result is clamped to what a float holds.

#include "rig/motion/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/gtc/quaternion.hpp>

namespace blush {
namespace {

/// The two keys around a time: `fraction` of the way from `key` to key + 1; 0 and the key itself where one key holds.
struct Place {
    std::size_t key = 0;
    double fraction = 0;
    double step_seconds = 0;
};

Place find_place(const Track& track, float time_seconds) {
    const auto& times = track.times_seconds;
    assert(!times.empty() && "a Track has at least one key");
    // Written so that NaN, for which every comparison is false, takes the first key.
    if (!(time_seconds > times.front())) return {};
    if (time_seconds >= times.back()) return {.key = times.size() - 1};
    const auto next = std::upper_bound(times.begin(), times.end(), time_seconds);
    const double before = static_cast<double>(*(next - 1));
    const double step = static_cast<double>(*next) - before;
    return {.key = static_cast<std::size_t>(next - times.begin()) - 1,
            .fraction = (static_cast<double>(time_seconds) - before) / step,
            .step_seconds = step};
}

float to_float(double value) {
    constexpr double limit = static_cast<double>(std::numeric_limits<float>::max());
    return static_cast<float>(std::clamp(value, -limit, limit));
}

/// Component `i` of the curve at `place`, before any normalisation.
double component(const Track& track, const Place& place, std::size_t i) {
    const std::size_t width = track.width;
    const auto at = [&](std::size_t index) { return static_cast<double>(track.values[index]); };
    const double u = place.fraction;
    if (track.interpolation == Interpolation::cubic_spline) {
        const std::size_t key = place.key * 3 * width + i;  // in-tangent, value, out-tangent
        const double value = at(key + width);
        if (u == 0) return value;
        const std::size_t next = key + 3 * width;
        const double out_tangent = at(key + 2 * width), in_tangent = at(next), next_value = at(next + width);
        const double u2 = u * u, u3 = u2 * u, td = place.step_seconds;
        return (2 * u3 - 3 * u2 + 1) * value + td * (u3 - 2 * u2 + u) * out_tangent + (-2 * u3 + 3 * u2) * next_value +
               td * (u3 - u2) * in_tangent;
    }
    const double value = at(place.key * width + i);
    if (u == 0 || track.interpolation == Interpolation::step) return value;
    return (1 - u) * value + u * at((place.key + 1) * width + i);
}

/// Keys are stored x, y, z, w; a key of no length, or a spline that passes through zero, counts as no rotation.
glm::dquat normalized(const glm::dquat& q) {
    const double length = glm::length(q);
    // 1e-12: far below any rotation that floats can mean, far above where the division loses digits.
    return length > 1e-12 ? q / length : glm::dquat(1, 0, 0, 0);
}

glm::dquat rotation_key(const Track& track, std::size_t key) {
    const Place place{.key = key};
    return normalized(glm::dquat(component(track, place, 3), component(track, place, 0), component(track, place, 1),
                                 component(track, place, 2)));
}

glm::dquat slerp_shorter(const glm::dquat& a, glm::dquat b, double u) {
    if (glm::dot(a, b) < 0) b = -b;
    // Half the chord over half the sum: exact for small angles, where acos of the dot product has no digits left.
    const double angle = 2 * std::atan2(glm::length(a - b), glm::length(a + b));
    // Below 1e-4 the chord and the arc differ by less than angle^2 / 6 = 2e-9 of themselves, under a float's precision.
    if (angle < 1e-4) return normalized(a * (1 - u) + b * u);
    return normalized((a * std::sin((1 - u) * angle) + b * std::sin(u * angle)) / std::sin(angle));
}

}  // namespace

void sample(const Track& track, float time_seconds, std::span<float> out) {
    assert(out.size() >= track.width && "sample() needs room for one value a component");
    const Place place = find_place(track, time_seconds);
    for (std::size_t i = 0; i < track.width; ++i) out[i] = to_float(component(track, place, i));
}

Quat sample_rotation(const Track& track, float time_seconds) {
    assert(track.width == 4 && "a rotation track has width 4");
    const Place place = find_place(track, time_seconds);
    glm::dquat q;
    if (track.interpolation == Interpolation::linear && place.fraction > 0) {
        q = slerp_shorter(rotation_key(track, place.key), rotation_key(track, place.key + 1), place.fraction);
    } else {
        q = normalized(glm::dquat(component(track, place, 3), component(track, place, 0), component(track, place, 1),
                                  component(track, place, 2)));
    }
    return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

}  // namespace blush
