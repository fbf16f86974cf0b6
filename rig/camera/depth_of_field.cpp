#include "rig/camera/depth_of_field.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr double pi = 3.14159265358979;
// Within half a pixel of the focus a pixel is sharp: it belongs to the layer of what is behind.
constexpr double sharp_radius = 0.5;

double covered(double radius, double distance) { return std::clamp(radius - distance + 0.5, 0.0, 1.0); }

/// Of a circle, one pixel at least.
double area(double radius) { return std::max(pi * radius * radius, 1.0); }

}  // namespace

double BlurRadius::at(double depth_mm) const {
    return std::clamp(scale_pixels * (1 - focus_mm / depth_mm), -largest_pixels, largest_pixels);
}

BlurRadius blur_radius(const ThinLens& lens, double height_pixels, double largest_pixels) {
    // Nothing can be focused at the focal length or nearer; a hundredth beyond it, the image is 100 times as large.
    const double focus = std::max(lens.focus_mm, 1.01 * lens.focal_length_mm);
    const double aperture_mm = lens.focal_length_mm / lens.f_number;
    const double largest_circle_mm = aperture_mm * lens.focal_length_mm / (focus - lens.focal_length_mm);
    return {0.5 * largest_circle_mm / lens.sensor_height_mm * height_pixels, focus, largest_pixels};
}

std::vector<glm::vec2> blur_taps(std::uint32_t count) {
    const double golden_angle = pi * (3 - std::sqrt(5.0));
    std::vector<glm::vec2> taps;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double r = std::sqrt(i / (count - 0.5)), angle = i * golden_angle;
        taps.emplace_back(static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)));
    }
    return taps;
}

Map<glm::dvec3> defocused(const Map<glm::dvec3>& radiance_linear, const Map<float>& radius_pixels,
                          std::span<const glm::vec2> taps, std::uint32_t tile_pixels) {
    const auto width = static_cast<int>(radiance_linear.width), height = static_cast<int>(radiance_linear.height);
    const auto tile = static_cast<int>(tile_pixels);
    Map<float> in_front(static_cast<std::uint32_t>((width + tile - 1) / tile),
                        static_cast<std::uint32_t>((height + tile - 1) / tile), 0.0F);
    for (std::uint32_t y = 0; y < radiance_linear.height; ++y) {
        for (std::uint32_t x = 0; x < radiance_linear.width; ++x) {
            float& largest = in_front.at(x / tile_pixels, y / tile_pixels);
            largest = std::max(largest, -radius_pixels.at(x, y));
        }
    }
    Map<glm::dvec3> result = radiance_linear;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto ux = static_cast<std::uint32_t>(x), uy = static_cast<std::uint32_t>(y);
            const float own = radius_pixels.at(ux, uy);
            float reach = std::abs(own);
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    const int tx = x / tile + dx, ty = y / tile + dy;
                    if (tx < 0 || ty < 0 || tx >= static_cast<int>(in_front.width) ||
                        ty >= static_cast<int>(in_front.height))
                        continue;
                    reach =
                        std::max(reach, in_front.at(static_cast<std::uint32_t>(tx), static_cast<std::uint32_t>(ty)));
                }
            }
            if (reach < 0.5F) continue;
            const double tap_area = pi * static_cast<double>(reach * reach) / static_cast<double>(taps.size());
            const bool blurred_in_front = static_cast<double>(own) < -sharp_radius;
            glm::dvec3 near_sum(0), far_sum(0);
            double near_weight = 0, far_weight = 0;
            for (const glm::vec2 tap : taps) {
                const glm::ivec2 offset(glm::floor(tap * reach + 0.5F));
                const int sx = std::clamp(x + offset.x, 0, width - 1), sy = std::clamp(y + offset.y, 0, height - 1);
                const auto tx = static_cast<std::uint32_t>(sx), ty = static_cast<std::uint32_t>(sy);
                const double distance = glm::length(glm::dvec2(offset));
                const double radius = static_cast<double>(radius_pixels.at(tx, ty));
                const glm::dvec3 color = radiance_linear.at(tx, ty);
                if (radius < -sharp_radius) {
                    const double weight = covered(-radius, distance) * tap_area / area(radius);
                    near_sum += weight * color;
                    near_weight += weight;
                    continue;
                }
                // Behind this pixel: no further than its own circle. Behind what is in front of the focus: a filling.
                const double circle = std::min(std::max(radius, 0.0), std::max(static_cast<double>(own), 0.0));
                const double weight = blurred_in_front ? 1 : covered(circle, distance) / area(circle);
                far_sum += weight * color;
                far_weight += weight;
            }
            const glm::dvec3 far = far_weight > 0 ? far_sum / far_weight : near_sum / std::max(near_weight, 1e-9);
            const glm::dvec3 near = near_weight > 0 ? near_sum / near_weight : far;
            result.at(ux, uy) = glm::mix(far, near, std::min(near_weight, 1.0));
        }
    }
    return result;
}

}  // namespace blush
