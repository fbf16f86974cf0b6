#pragma once
/// Small shared mathematics of the face maker. Lengths are millimetres, +X the face's own left, +Y up, +Z forward.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace blush::make_face {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radians(double degrees) { return degrees * pi / 180; }
inline double mix(double a, double b, double t) { return a + (b - a) * t; }
inline double square(double x) { return x * x; }

/// 0 at or below `low`, 1 at or above `high`, smooth between; also falls when high < low.
inline double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A bell that is 1 at 0 and e^-1 where |x| = width.
inline double bell(double x, double width) { return std::exp(-square(x / width)); }

/// A bell in space, 1 at `centre`, with a width for each axis.
inline double bell(const Vec3& p, const Vec3& centre, const Vec3& widths) {
    const Vec3 d = (p - centre) / widths;
    return std::exp(-glm::dot(d, d));
}

/// The same point on the other half of the face.
inline Vec3 mirrored(const Vec3& p) { return {-p.x, p.y, p.z}; }

/// Value noise in [-1, 1] with a cell of one unit, from an integer hash: the same on every machine.
double noise(const Vec3& p);

/// Sum of `octaves` of noise, each half as large and half as strong; within [-2, 2].
double fractal_noise(Vec3 p, int octaves);

}  // namespace blush::make_face
