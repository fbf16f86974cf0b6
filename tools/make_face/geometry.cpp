#include "tools/make_face/geometry.h"

namespace blush::make_face {
namespace {

/// PCG-style hash of a lattice point (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering"), to [-1, 1].
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z) {
    auto h = static_cast<std::uint32_t>(x) * 1664525U + static_cast<std::uint32_t>(y) * 22695477U +
             static_cast<std::uint32_t>(z) * 747796405U + 1013904223U;
    h = ((h >> ((h >> 28U) + 4U)) ^ h) * 277803737U;
    h = (h >> 22U) ^ h;
    h = ((h >> ((h >> 28U) + 4U)) ^ h) * 277803737U;
    h = (h >> 22U) ^ h;
    return static_cast<double>(h) / 2147483647.5 - 1;
}

}  // namespace

double noise(const Vec3& p) {
    const Vec3 cell = glm::floor(p);
    const Vec3 f = p - cell;
    const Vec3 s = f * f * (3.0 - 2.0 * f);
    const auto x = static_cast<std::int64_t>(cell.x), y = static_cast<std::int64_t>(cell.y),
               z = static_cast<std::int64_t>(cell.z);
    const auto row = [&](std::int64_t dy, std::int64_t dz) {
        return mix(lattice_value(x, y + dy, z + dz), lattice_value(x + 1, y + dy, z + dz), s.x);
    };
    return mix(mix(row(0, 0), row(1, 0), s.y), mix(row(0, 1), row(1, 1), s.y), s.z);
}

double fractal_noise(Vec3 p, int octaves) {
    double sum = 0, strength = 1;
    for (int i = 0; i < octaves; ++i) {
        sum += strength * noise(p);
        p = p * 2.0 + Vec3(17.3, 5.1, 29.7);
        strength /= 2;
    }
    return sum;
}

}  // namespace blush::make_face
