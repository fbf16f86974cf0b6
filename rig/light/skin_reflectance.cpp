#include "rig/light/skin_reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace blush {

double schlick_fresnel(double v_dot_h, double f0) { return f0 + (1 - f0) * std::pow(1 - v_dot_h, 5); }

double beckmann(double n_dot_h, double roughness) {
    const double cosine2 = n_dot_h * n_dot_h, m2 = roughness * roughness;
    if (cosine2 <= 0) return 0;
    return std::exp(-(1 - cosine2) / (cosine2 * m2)) / (m2 * cosine2 * cosine2);
}

double skin_specular(double n_dot_h, double v_dot_h, double h_length2, double roughness, double f0) {
    if (h_length2 <= 0) return 0;
    return beckmann(n_dot_h, roughness) * schlick_fresnel(v_dot_h, f0) / (std::numbers::pi * h_length2);
}

double skin_specular_albedo(double n_dot_l, double roughness, std::uint32_t steps) {
    const glm::dvec3 l(std::sqrt(std::max(0.0, 1 - n_dot_l * n_dot_l)), 0, n_dot_l);
    // Half vectors are what the distribution is narrow in: h is drawn in slope space by Beckmann's own inverse
    // (tan^2 = -m^2 ln(1 - u)), so that every midpoint carries an equal share of the distribution.
    double sum = 0;
    const double share = 1.0 / (static_cast<double>(steps) * steps);
    for (std::uint32_t i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps;
        const double tangent2 = -roughness * roughness * std::log1p(-u);
        const double cosine = 1 / std::sqrt(1 + tangent2), sine = std::sqrt(1 - cosine * cosine);
        for (std::uint32_t j = 0; j < steps; ++j) {
            const double phi = (j + 0.5) / steps * std::numbers::pi;  // the other half is its mirror image
            const glm::dvec3 h(sine * std::cos(phi), sine * std::sin(phi), cosine);
            const double l_dot_h = glm::dot(l, h);
            if (l_dot_h <= 0) continue;
            const glm::dvec3 v = 2 * l_dot_h * h - l;
            if (v.z <= 0) continue;
            // pdf of h: D cos / pi; of v: that / (4 l.h). |l + v|^2 = 4 (l.h)^2, so f cos_v / pdf is
            // F v.z 4 l.h / (4 (l.h)^2 cos_h).
            sum += share * schlick_fresnel(l_dot_h) * v.z / (l_dot_h * cosine);
        }
    }
    return sum;
}

std::vector<float> beckmann_table(std::uint32_t side) {
    std::vector<float> table;
    table.reserve(std::size_t{side} * side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const double d = x > 0 ? beckmann(x / (side - 1.0), (y + 0.5) / side) : 0;  // none lie along the surface
            table.push_back(static_cast<float>(0.5 * std::pow(d, 0.1)));
        }
    }
    return table;
}

double skin_specular_albedo_mean(double roughness, std::uint32_t steps) {
    // Gauss-Legendre of five points on [0, 1].
    constexpr std::array<double, 5> points = {0.0469100770, 0.2307653449, 0.5, 0.7692346551, 0.9530899230};
    constexpr std::array<double, 5> weights = {0.1184634425, 0.2393143352, 0.2844444444, 0.2393143352, 0.1184634425};
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum += 2 * weights[i] * points[i] * skin_specular_albedo(points[i], roughness, steps);
    }
    return sum;
}

std::vector<float> specular_albedo_table(std::uint32_t columns, std::uint32_t rows, std::uint32_t steps) {
    std::vector<float> table;
    table.reserve(std::size_t{2} * columns * rows);
    for (std::uint32_t y = 0; y < rows; ++y) {
        const double roughness = (y + 0.5) / rows;
        const auto mean = static_cast<float>(skin_specular_albedo_mean(roughness, steps));
        for (std::uint32_t x = 0; x < columns; ++x) {
            table.push_back(
                static_cast<float>(skin_specular_albedo(std::max(x / (columns - 1.0), 1e-3), roughness, steps)));
            table.push_back(mean);
        }
    }
    return table;
}

}  // namespace blush
