/// Radiance maps, prepared: spherical-harmonics coefficients, and copies filtered for rough mirrors.

#include <algorithm>
#include <atomic>
#include <cmath>

#include "runtime/lighting.h"

namespace blush {
namespace {

// Base of the filtered copies. The sharpest reflection that skin and eyes show here is some degrees wide; a texel
// is 2.8.
constexpr std::uint32_t base_width = 128, base_height = 64, level_count = 5;

float clean(float value) {
    // Brighter texels than this would overflow the half floats of the scene colour.
    constexpr float brightest = 6e4F;
    return std::isfinite(value) ? std::clamp(value, 0.0F, brightest) : 0.0F;
}

Environment::Level averaged(const Image& image, const std::vector<float>& pixels, std::uint32_t width,
                            std::uint32_t height) {
    Environment::Level level{width, height, std::vector<float>(std::size_t{width} * height * 3, 0.0F)};
    std::vector<double> counts(std::size_t{width} * height, 0);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::size_t to = std::size_t{y * height / image.height} * width + x * width / image.width;
            for (std::size_t c = 0; c < 3; ++c) {
                level.rgb_linear[3 * to + c] += pixels[3 * (std::size_t{y} * image.width + x) + c];
            }
            ++counts[to];
        }
    }
    for (std::size_t p = 0; p < counts.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c) level.rgb_linear[3 * p + c] /= static_cast<float>(std::max(counts[p], 1.0));
    }
    return level;
}

/// What a mirror of that roughness shows in each direction: Beckmann's distribution of the half vector between the
/// mirrored direction and the light's, weighted with the cosine between them.
Environment::Level filtered(const Environment::Level& source, std::uint32_t width, std::uint32_t height,
                            double roughness) {
    Environment::Level level{width, height, std::vector<float>(std::size_t{width} * height * 3, 0.0F)};
    std::vector<glm::dvec4> lights;  // direction, solid angle
    for (std::uint32_t y = 0; y < source.height; ++y) {
        for (std::uint32_t x = 0; x < source.width; ++x) {
            const double v = (y + 0.5) / source.height;
            lights.emplace_back(environment_direction((x + 0.5) / source.width, v), std::sin(3.14159265358979 * v));
        }
    }
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::dvec3 mirrored = environment_direction((x + 0.5) / width, (y + 0.5) / height);
            glm::dvec3 sum(0);
            double total = 0;
            for (std::size_t i = 0; i < lights.size(); ++i) {
                const double cosine = glm::dot(mirrored, glm::dvec3(lights[i]));
                if (cosine <= 0) continue;
                const double tangent2 = (1 - cosine) / (1 + cosine);  // of half the angle
                const double weight = lights[i].w * cosine * std::exp(-tangent2 / (roughness * roughness));
                total += weight;
                for (glm::length_t c = 0; c < 3; ++c) {
                    sum[c] += weight * static_cast<double>(source.rgb_linear[3 * i + static_cast<std::size_t>(c)]);
                }
            }
            for (glm::length_t c = 0; c < 3; ++c) {
                level.rgb_linear[3 * (std::size_t{y} * width + x) + static_cast<std::size_t>(c)] =
                    static_cast<float>(total > 0 ? sum[c] / total : 0);
            }
        }
    }
    return level;
}

}  // namespace

Result<std::shared_ptr<const Environment>> make_environment(const Image& image) {
    if (image.width == 0 || image.height == 0 || image.channels == 0) {
        return Error{"environment \"" + image.name + "\" has no pixels"};
    }
    const std::size_t count = std::size_t{image.width} * image.height;
    std::vector<float> pixels(3 * count);
    for (std::size_t p = 0; p < count; ++p) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = p * image.channels + (image.channels >= 3 ? c : 0);
            pixels[3 * p + c] =
                image.bytes.empty() ? clean(image.floats[at]) : static_cast<float>(image.bytes[at]) / 255.0F;
        }
    }
    auto environment = std::make_shared<Environment>();
    environment->radiance_sh = project_environment(pixels, image.width, image.height, 3);
    const std::uint32_t width = std::min(base_width, image.width), height = std::min(base_height, image.height);
    environment->levels.push_back(averaged(image, pixels, width, height));
    for (std::uint32_t k = 1; k < level_count; ++k) {
        const std::uint32_t w = std::max(1U, width >> k), h = std::max(1U, height >> k);
        // The source need not be finer than half of what the lobe is wide.
        const Environment::Level source =
            averaged(image, pixels, std::max(1U, std::min(width, 2 * w)), std::max(1U, std::min(height, 2 * h)));
        environment->levels.push_back(filtered(source, w, h, static_cast<double>(k) / (level_count - 1)));
    }
    static std::atomic<std::uint64_t> made = 0;
    environment->identity = ++made;
    return std::shared_ptr<const Environment>(std::move(environment));
}

}  // namespace blush
