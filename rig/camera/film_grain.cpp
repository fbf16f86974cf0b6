#include "rig/camera/film_grain.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

/// PCG of three words (Jarzynski and Olano 2020, pcg3d).
std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, bool second) {
    x = x * 1664525U + 1013904223U;
    y = y * 1664525U + 1013904223U;
    z = z * 1664525U + 1013904223U;
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    x += y * z;
    y += z * x;
    return second ? y : x;
}

constexpr double unit = 1.0 / 65536;

/// Sum of two uniform values, scaled to variance 1: within sqrt(6) of 0.
double lattice(std::int64_t x, std::int64_t y, std::uint32_t time) {
    const auto a = static_cast<std::uint32_t>(x), b = static_cast<std::uint32_t>(y);
    const double first = (hash(a, b, time, false) >> 16) * unit, second = (hash(a, b, time, true) >> 16) * unit;
    return (first + second - 1 + unit) * std::sqrt(6.0);
}

}  // namespace

double film_grain_reach(double size_pixels) {
    // Between four lattice points their weighted sum may be twice its deviation larger.
    return size_pixels > 1 ? 2 * std::sqrt(6.0) : std::sqrt(6.0);
}

double film_grain_noise(std::uint32_t x, std::uint32_t y, std::uint32_t frame, std::uint32_t seed, double size_pixels) {
    const std::uint32_t time = frame + 0x9e3779b9U * seed;
    if (!(size_pixels > 1)) return lattice(x, y, time);
    const double u = x / size_pixels, v = y / size_pixels;
    const double fu = u - std::floor(u), fv = v - std::floor(v);
    const auto i = static_cast<std::int64_t>(std::floor(u)), j = static_cast<std::int64_t>(std::floor(v));
    const double weights[4] = {(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
    double sum = 0, squares = 0;
    for (int k = 0; k < 4; ++k) {
        sum += weights[k] * lattice(i + (k & 1), j + (k >> 1), time);
        squares += weights[k] * weights[k];
    }
    return sum / std::sqrt(squares);
}

double film_grain_deviation(double display_value, double strength, double size_pixels) {
    const double value = std::clamp(display_value, 0.0, 1.0);
    return std::min(2 * strength * std::sqrt(value * (1 - value)),
                    std::min(value, 1 - value) / film_grain_reach(size_pixels));
}

}  // namespace blush
