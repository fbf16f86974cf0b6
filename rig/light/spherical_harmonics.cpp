#include "rig/light/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr double pi = std::numbers::pi;

/// Band of coefficient i: i = l (l + 1) + m.
constexpr std::array<std::size_t, 9> band_of = {0, 1, 1, 1, 2, 2, 2, 2, 2};

/// Solves a[n][n] x = b[n][m] in place by elimination with pivoting; the matrices here are small and well conditioned.
template <std::size_t N>
void solve(std::array<std::array<double, N>, N>& a, std::array<std::array<double, N>, N>& b) {
    for (std::size_t k = 0; k < N; ++k) {
        std::size_t pivot = k;
        for (std::size_t r = k + 1; r < N; ++r) {
            if (std::abs(a[r][k]) > std::abs(a[pivot][k])) pivot = r;
        }
        std::swap(a[k], a[pivot]);
        std::swap(b[k], b[pivot]);
        for (std::size_t r = 0; r < N; ++r) {
            if (r == k) continue;
            const double factor = a[r][k] / a[k][k];
            for (std::size_t c = 0; c < N; ++c) {
                a[r][c] -= factor * a[k][c];
                b[r][c] -= factor * b[k][c];
            }
        }
    }
    for (std::size_t k = 0; k < N; ++k) {
        for (std::size_t c = 0; c < N; ++c) b[k][c] /= a[k][k];
    }
}

/// The block of one band. A rotated function's values in some directions are the function's values in the directions
/// turned back: B(w) M = B(R^-1 w) for as many directions as the band has coefficients.
template <std::size_t N>
void rotate_band(const glm::dmat3& back, std::size_t first, const std::array<glm::dvec3, N>& directions,
                 std::array<Sh9, 9>& matrix) {
    std::array<std::array<double, N>, N> here{}, there{};
    for (std::size_t d = 0; d < N; ++d) {
        const Sh9 at = sh_basis(directions[d]), turned = sh_basis(back * directions[d]);
        for (std::size_t i = 0; i < N; ++i) {
            here[d][i] = at[first + i];
            there[d][i] = turned[first + i];
        }
    }
    solve(here, there);
    for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = 0; j < N; ++j) matrix[first + i][first + j] = there[i][j];
    }
}

}  // namespace

Sh9 sh_basis(glm::dvec3 w) {
    const double k0 = std::sqrt(1 / (4 * pi)), k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (4 * pi));
    return {k0,
            k1 * w.y,
            k1 * w.z,
            k1 * w.x,
            k2 * w.x * w.y,
            k2 * w.y * w.z,
            std::sqrt(5 / (16 * pi)) * (3 * w.z * w.z - 1),
            k2 * w.x * w.z,
            0.5 * k2 * (w.x * w.x - w.y * w.y)};
}

Sh9 clamped_cosine(glm::dvec3 normal) {
    constexpr std::array<double, 3> convolution = {pi, 2 * pi / 3, pi / 4};
    Sh9 result = sh_basis(normal);
    for (std::size_t i = 0; i < 9; ++i) result[i] *= convolution[band_of[i]];
    return result;
}

glm::dvec3 dot(const Sh9Color& light, const Sh9& transfer) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 9; ++i) sum += transfer[i] * light[i];
    return sum;
}

std::array<Sh9, 9> sh_rotation(const glm::dmat3& rotation) {
    const glm::dmat3 back = glm::transpose(rotation);
    std::array<Sh9, 9> matrix{};
    matrix[0][0] = 1;
    rotate_band<3>(back, 1, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, matrix);
    const double d = std::sqrt(0.5);
    rotate_band<5>(back, 4, {{{1, 0, 0}, {0, 0, 1}, {d, d, 0}, {d, 0, d}, {0, d, d}}}, matrix);
    return matrix;
}

Sh9 rotate(const std::array<Sh9, 9>& matrix, const Sh9& coefficients) {
    Sh9 result{};
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j < 9; ++j) result[i] += matrix[i][j] * coefficients[j];
    }
    return result;
}

Sh9Color rotate(const std::array<Sh9, 9>& matrix, const Sh9Color& coefficients) {
    Sh9Color result{};
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j < 9; ++j) result[i] += matrix[i][j] * coefficients[j];
    }
    return result;
}

glm::dvec3 environment_direction(double u, double v) {
    const double longitude = 2 * pi * (u - 0.5), latitude = pi * (0.5 - v);
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
}

Sh9Color project_environment(std::span<const float> pixels, std::uint32_t width, std::uint32_t height,
                             std::uint32_t channels) {
    Sh9Color result{};
    for (std::uint32_t y = 0; y < height; ++y) {
        // The exact solid angle of a row's pixels: equal steps of longitude between two latitudes.
        const double top = std::cos(pi * y / height), bottom = std::cos(pi * (y + 1) / height);
        const double solid_angle = 2 * pi / width * (top - bottom);
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t at = (std::size_t{y} * width + x) * channels;
            glm::dvec3 radiance(0);
            for (std::uint32_t c = 0; c < 3; ++c) {
                const float value = pixels[at + (channels >= 3 ? c : 0)];
                if (std::isfinite(value))
                    radiance[static_cast<glm::length_t>(c)] = static_cast<double>(std::max(0.0F, value));
            }
            const Sh9 basis = sh_basis(environment_direction((x + 0.5) / width, (y + 0.5) / height));
            for (std::size_t i = 0; i < 9; ++i) result[i] += solid_angle * basis[i] * radiance;
        }
    }
    return result;
}

}  // namespace blush
