#include "rig/wrinkles/derivative_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace blush {

glm::vec2 derivative_from_normal(glm::vec3 n, float range) {
    if (!std::isfinite(n.x) || !std::isfinite(n.y) || !std::isfinite(n.z)) return glm::vec2(0);
    const float steepest = std::max(std::abs(n.x), std::abs(n.y));
    if (steepest == 0) return glm::vec2(0);
    // At n_z = steepest / range the larger component reaches the range; what lies below keeps its direction.
    if (n.z * range <= steepest) return glm::vec2(n.x, n.y) * (range / steepest);
    return {n.x / n.z, n.y / n.z};
}

glm::vec3 normal_from_derivative(glm::vec2 derivative) {
    return glm::vec3(derivative, 1) * (1 / std::sqrt(1 + glm::dot(derivative, derivative)));
}

DerivativeMap derivatives_from_normals(const NormalMap& normals, float range, double* saturated) {
    DerivativeMap map;
    map.width = normals.width;
    map.height = normals.height;
    map.values.reserve(normals.values.size());
    std::size_t cut_off = 0;
    for (const glm::vec3& n : normals.values) {
        map.values.push_back(derivative_from_normal(n, range));
        if (std::max(std::abs(n.x), std::abs(n.y)) > n.z * range) ++cut_off;
    }
    if (saturated != nullptr) {
        *saturated = normals.values.empty() ? 0 : static_cast<double>(cut_off) / static_cast<double>(map.values.size());
    }
    return map;
}

DerivativeMap derivatives_from_heights(std::span<const float> heights, std::uint32_t width, std::uint32_t height,
                                       glm::vec2 texel_size) {
    assert(heights.size() == std::size_t{width} * height && "one height for each texel");
    DerivativeMap map(width, height);
    const auto at = [&](std::uint32_t x, std::uint32_t y) { return heights[std::size_t{y} * width + x]; };
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t left = x == 0 ? 0 : x - 1, right = std::min(x + 1, width - 1);
            const std::uint32_t up = y == 0 ? 0 : y - 1, down = std::min(y + 1, height - 1);
            const float run_x = static_cast<float>(std::max(right - left, 1U)) * texel_size.x;
            const float run_y = static_cast<float>(std::max(down - up, 1U)) * texel_size.y;
            map.values[std::size_t{y} * width + x] = {(at(left, y) - at(right, y)) / run_x,
                                                      (at(x, up) - at(x, down)) / run_y};
        }
    }
    return map;
}

std::int8_t stored_derivative(float derivative, float range) {
    constexpr float largest = 127;  // SNORM8 maps -127 to 127 to -1 to 1 (GL 4.5, 2.3.5.1); -128 is never written
    const float scaled = std::isfinite(derivative) ? derivative / range * largest : 0;
    return static_cast<std::int8_t>(std::lround(std::clamp(scaled, -largest, largest)));
}

float derivative_from_stored(std::int8_t stored, float range) {
    return std::max(static_cast<float>(stored) / 127.0F, -1.0F) * range;
}

glm::vec3 normal_difference(glm::vec3 wrinkled, glm::vec3 base) {
    return glm::clamp(wrinkled - base, glm::vec3(-1), glm::vec3(1));
}

glm::vec3 add_normal_difference(glm::vec3 base, glm::vec3 difference, float weight) {
    const glm::vec3 sum = base + difference * weight;
    const float length2 = glm::dot(sum, sum);
    return length2 > 1e-12F ? sum * (1 / std::sqrt(length2)) : base;
}

}  // namespace blush
