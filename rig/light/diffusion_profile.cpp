#include "rig/light/diffusion_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr std::array<GaussianTerm, 6> six = {{
    {0.0064, {0.233, 0.455, 0.649}},
    {0.0484, {0.100, 0.336, 0.344}},
    {0.187, {0.118, 0.198, 0.000}},
    {0.567, {0.113, 0.007, 0.007}},
    {1.99, {0.358, 0.004, 0.000}},
    {7.41, {0.078, 0.000, 0.000}},
}};

constexpr std::array<GaussianTerm, 4> four = {{
    {0.0064, {0.2405, 0.4474, 0.6157}},
    {0.0516, {0.1158, 0.3661, 0.3439}},
    {0.2719, {0.1836, 0.1864, 0.0000}},
    {2.0062, {0.4600, 0.0000, 0.0402}},
}};

// Jensen et al. 2001, figure 5; refractive indices as there: 1.5 for marble, 1.3 for the rest.
constexpr std::array<ScatteringMaterial, 10> materials = {{
    {"marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, 1.5},
    {"skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, 1.3},
    {"skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, 1.3},
    {"wholemilk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, 1.3},
    {"skimmilk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, 1.3},
    {"potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, 1.3},
    {"apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, 1.3},
    {"ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, 1.3},
    {"cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, 1.3},
    {"chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, 1.3},
}};

template <class Share>
glm::dvec3 weighted(std::span<const GaussianTerm> profile, Share share) {
    glm::dvec3 sum(0);
    for (const GaussianTerm& term : profile) sum += term.weight * share(term.variance_mm2);
    return sum;
}

}  // namespace

std::span<const GaussianTerm> skin_six_gaussians() { return six; }
std::span<const GaussianTerm> skin_four_gaussians() { return four; }
std::span<const ScatteringMaterial> measured_materials() { return materials; }

glm::dvec3 profile_at(std::span<const GaussianTerm> profile, double r_mm) {
    return weighted(profile, [r_mm](double variance) {
        return std::exp(-r_mm * r_mm / (2 * variance)) / (2 * std::numbers::pi * variance);
    });
}

glm::dvec3 step_response(std::span<const GaussianTerm> profile, double x_mm) {
    // A Gaussian's integral along the edge leaves a one-dimensional Gaussian; that one's integral is the error
    // function.
    return weighted(profile, [x_mm](double variance) { return 0.5 * std::erfc(-x_mm / std::sqrt(2 * variance)); });
}

glm::dvec3 transmittance(std::span<const GaussianTerm> profile, double s_mm) {
    return weighted(profile, [s_mm](double variance) { return std::exp(-s_mm * s_mm / (2 * variance)); });
}

glm::dvec3 transmittance_as_printed(std::span<const GaussianTerm> profile, double s_mm) {
    return weighted(profile, [s_mm](double variance) { return std::exp(-s_mm * s_mm / variance); });
}

glm::dvec3 dipole_at(const ScatteringMaterial& material, double r_mm) {
    const double eta = material.refractive_index;
    // Diffuse Fresnel reflectance at the inside of the boundary (Egan and Hilgeman 1973, as in the paper).
    const double diffuse_fresnel = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
    const double boundary = (1 + diffuse_fresnel) / (1 - diffuse_fresnel);
    glm::dvec3 result(0);
    for (glm::length_t c = 0; c < 3; ++c) {
        const double extinction = material.reduced_scattering_per_mm[c] + material.absorption_per_mm[c];
        const double albedo = material.reduced_scattering_per_mm[c] / extinction;
        const double transport = std::sqrt(3 * material.absorption_per_mm[c] * extinction);
        const double real_depth = 1 / extinction;
        const double virtual_depth = real_depth * (1 + 4 * boundary / 3);
        const auto source = [&](double depth) {
            const double d = std::sqrt(r_mm * r_mm + depth * depth);
            return depth * (transport * d + 1) * std::exp(-transport * d) / (d * d * d);
        };
        result[c] = albedo / (4 * std::numbers::pi) * (source(real_depth) + source(virtual_depth));
    }
    return result;
}

namespace {

/// Light that leaves within each of `radii_mm` of where it entered, of all that
/// leaves: the dipole's integral, by the midpoint rule in the logarithm of the
/// distance.
std::vector<glm::dvec3> light_within(const ScatteringMaterial& material, std::span<const double> radii_mm) {
    constexpr int steps = 64;  // between two radii
    std::vector<glm::dvec3> within;
    glm::dvec3 sum(0);
    double from = radii_mm.front() * 1e-3;
    for (const double to : radii_mm) {
        const double step = std::log(to / from) / steps;
        for (int i = 0; i < steps; ++i) {
            const double r = from * std::exp((i + 0.5) * step);
            sum += dipole_at(material, r) * (2 * std::numbers::pi * r * r * step);
        }
        within.push_back(sum);
        from = to;
    }
    for (glm::dvec3& value : within) value /= sum;
    return within;
}

}  // namespace

std::vector<GaussianTerm> gaussians_of(const ScatteringMaterial& material) {
    // How far light goes in the channel in which it goes farthest and least: the
    // widths lie between.
    double farthest = 0, nearest = 1e9;
    for (glm::length_t c = 0; c < 3; ++c) {
        const double extinction = material.reduced_scattering_per_mm[c] + material.absorption_per_mm[c];
        farthest = std::max(farthest, 1 / std::sqrt(3 * material.absorption_per_mm[c] * extinction));
        nearest = std::min(nearest, 1 / extinction);
    }
    std::vector<GaussianTerm> terms(most_gaussian_terms);
    const double low = std::log(0.3 * nearest), high = std::log(1.6 * farthest);
    for (std::size_t g = 0; g < terms.size(); ++g) {
        const double sigma =
            std::exp(low + (high - low) * static_cast<double>(g) / static_cast<double>(terms.size() - 1));
        terms[g].variance_mm2 = sigma * sigma;
    }
    std::vector<double> radii;
    constexpr int radius_count = 96;
    for (int i = 0; i < radius_count; ++i) {
        radii.push_back(0.1 * nearest * std::pow(120 * farthest / nearest, (i + 1.0) / radius_count));
    }
    const std::vector<glm::dvec3> wanted = light_within(material, radii);
    for (glm::length_t c = 0; c < 3; ++c) {
        // Coordinate descent: the residual's projection on one Gaussian at a time,
        // kept at 0 or above. It converges to the least squares since the problem
        // is convex.
        std::vector<std::vector<double>> columns;
        for (const GaussianTerm& term : terms) {
            std::vector<double> column;
            for (const double r : radii) column.push_back(1 - std::exp(-r * r / (2 * term.variance_mm2)));
            columns.push_back(std::move(column));
        }
        std::vector<double> residual;
        for (const glm::dvec3& value : wanted) residual.push_back(value[c]);
        std::vector<double> weights(terms.size(), 0.0);
        for (int sweep = 0; sweep < 4000; ++sweep) {
            for (std::size_t g = 0; g < terms.size(); ++g) {
                double along = 0, length2 = 0;
                for (std::size_t i = 0; i < residual.size(); ++i) {
                    along += residual[i] * columns[g][i];
                    length2 += columns[g][i] * columns[g][i];
                }
                const double next = std::max(0.0, weights[g] + along / length2), change = next - weights[g];
                weights[g] = next;
                for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= change * columns[g][i];
            }
        }
        double sum = 0;
        for (const double weight : weights) sum += weight;
        for (std::size_t g = 0; g < terms.size(); ++g) terms[g].weight[c] = weights[g] / sum;
    }
    return terms;
}

}  // namespace blush
