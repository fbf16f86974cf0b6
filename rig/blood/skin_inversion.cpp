/// N. Tsumura et al., "Image-based skin color and texture analysis/synthesis by extracting hemoglobin and melanin
/// information in the skin", SIGGRAPH 2003: pigments and shading as directions in density. The directions here come
/// from the spectral model and not from the statistics of a picture.
#include "rig/blood/skin_inversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush {
namespace {

/// Nodes a side of the grid on which the search walks: steps below a hundredth of the noticeable.
constexpr std::uint32_t search_nodes = 97;
/// Nodes between the starting points that are tried.
constexpr std::uint32_t start_stride = 6;

}  // namespace

glm::vec3 skin_density(const glm::vec3& colour) {
    glm::vec3 density(0);
    for (glm::length_t c = 0; c < 3; ++c) {
        const float value = std::isfinite(colour[c]) ? std::max(colour[c], density_floor) : density_floor;
        density[c] = -std::log(value);
    }
    return {(density.r + density.g + density.b) / 3, density.g - density.r, density.b - (density.r + density.g) / 2};
}

SkinInverter::SkinInverter(const SkinColourTable& table, const glm::vec3& white_linear, float lightness_weight)
    : nodes_(search_nodes), white_(white_linear), lightness_weight_(lightness_weight) {
    for (std::uint32_t y = 0; y < nodes_; ++y) {
        for (std::uint32_t x = 0; x < nodes_; ++x) {
            const glm::vec2 uv = glm::vec2(x, y) / static_cast<float>(nodes_ - 1);
            densities_.push_back(skin_density(table.colour_linear_at(uv)));
        }
    }
}

glm::vec3 SkinInverter::density_at(glm::vec2 uv) const {
    const glm::vec2 place = uv * static_cast<float>(nodes_ - 1);
    const auto x = std::min(static_cast<std::uint32_t>(place.x), nodes_ - 2);
    const auto y = std::min(static_cast<std::uint32_t>(place.y), nodes_ - 2);
    const glm::vec3* const node = &densities_[std::size_t{y} * nodes_ + x];
    const float s = place.x - static_cast<float>(x), t = place.y - static_cast<float>(y);
    return glm::mix(glm::mix(node[0], node[1], s), glm::mix(node[nodes_], node[nodes_ + 1], s), t);
}

SkinReading SkinInverter::read(const glm::vec3& colour) const {
    const glm::vec3 wanted = skin_density(colour / white_);
    const glm::vec3 weights(lightness_weight_, 1, yellowness_weight);
    const auto misfit = [&](glm::vec2 uv) { return weights * (density_at(uv) - wanted); };
    const auto cost_of = [](const glm::vec3& error) { return glm::dot(error, error); };

    glm::vec2 best(0);
    float cost = std::numeric_limits<float>::infinity();
    for (std::uint32_t y = 0; y < nodes_; y += start_stride) {
        for (std::uint32_t x = 0; x < nodes_; x += start_stride) {
            const float here = cost_of(weights * (densities_[std::size_t{y} * nodes_ + x] - wanted));
            if (here >= cost) continue;
            cost = here;
            best = glm::vec2(x, y) / static_cast<float>(nodes_ - 1);
        }
    }

    // Levenberg and Marquardt's damped Gauss-Newton in the unit square. Skin needs about six steps; near the axes,
    // where the cube flattens the table, it can take three times as many.
    float damping = 1e-4F;
    for (int step = 0; step < 24; ++step) {
        // Differences over one cell of the grid, towards the inside.
        const float h = 1.0F / static_cast<float>(nodes_ - 1);
        const float hu = best.x < 0.5F ? h : -h, hv = best.y < 0.5F ? h : -h;
        const glm::vec3 error = misfit(best);
        const glm::vec3 du = (misfit(best + glm::vec2(hu, 0)) - error) / hu;
        const glm::vec3 dv = (misfit(best + glm::vec2(0, hv)) - error) / hv;
        float uu = glm::dot(du, du), vv = glm::dot(dv, dv), uv = glm::dot(du, dv);
        float u_error = glm::dot(du, error), v_error = glm::dot(dv, error);
        // A coordinate that stands at its end and wants beyond stays there, and the other moves alone.
        const bool u_held = (best.x <= 0 && u_error > 0) || (best.x >= 1 && u_error < 0);
        const bool v_held = (best.y <= 0 && v_error > 0) || (best.y >= 1 && v_error < 0);
        if (u_held) uv = u_error = 0;
        if (v_held) uv = v_error = 0;
        uu *= 1 + damping;
        vv *= 1 + damping;
        const float determinant = uu * vv - uv * uv;
        if (!(determinant > 0)) break;
        const glm::vec2 move = glm::vec2(vv * u_error - uv * v_error, uu * v_error - uv * u_error) / determinant;
        const glm::vec2 next = glm::clamp(best - move, glm::vec2(0), glm::vec2(1));
        const float next_cost = cost_of(misfit(next));
        if (next_cost < cost) {
            const float moved = glm::length(next - best);
            best = next;
            cost = next_cost;
            damping *= 0.3F;
            if (moved < 1e-5F) break;  // a thousandth of a step of an 8-bit map
        } else {
            damping = damping * 10 + 1e-4F;
            if (damping > 1e3F) break;
        }
    }

    const glm::vec3 error = density_at(best) - wanted;
    SkinReading reading;
    reading.melanin = table_fraction(best.x, largest_melanin);
    reading.hemoglobin = table_fraction(best.y, largest_hemoglobin);
    reading.shading = std::exp(error.x);
    reading.chroma_error = std::hypot(error.y, error.z);
    return reading;
}

}  // namespace blush
