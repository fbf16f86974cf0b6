#include "rig/camera/exposure.h"

#include <algorithm>
#include <cmath>

namespace blush {

double log2_average_luminance(const Map<glm::dvec3>& radiance_linear, Metering metering) {
    constexpr double black = 1e-4, bell = 0.2, least_weight = 1e-3;
    double sum = 0, weights = 0;
    const double height = radiance_linear.height;
    for (std::uint32_t y = 0; y < radiance_linear.height; ++y) {
        for (std::uint32_t x = 0; x < radiance_linear.width; ++x) {
            const glm::dvec3 c = radiance_linear.at(x, y);
            const double luminance = glm::dot(glm::max(c, glm::dvec3(0)), glm::dvec3(0.2126, 0.7152, 0.0722));
            if (!std::isfinite(c.x + c.y + c.z) || !std::isfinite(luminance)) continue;
            double weight = 1;
            if (metering == Metering::centre) {
                const glm::dvec2 from_middle((x + 0.5 - 0.5 * radiance_linear.width) / height,
                                             (y + 0.5) / height - 0.5);
                weight = std::max(std::exp(-glm::dot(from_middle, from_middle) / (2 * bell * bell)), least_weight);
            }
            sum += weight * std::log2(luminance + black);
            weights += weight;
        }
    }
    return weights > 0 ? sum / weights : std::log2(black);
}

double log2_exposure(double log2_average, double key, double stops, double range_stops) {
    return std::clamp(std::log2(key) - log2_average + stops, -range_stops, range_stops);
}

double adapted(double log2_before, double log2_target, double seconds, double half_life_seconds) {
    return log2_before + (log2_target - log2_before) * (1 - std::exp2(-seconds / half_life_seconds));
}

}  // namespace blush
