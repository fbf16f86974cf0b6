#include "rig/light/scatter_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

struct Tap {
    glm::dvec4 light{0};
    double depth_mm = 0;  // times matte
};

/// Bilinear, with the edge's pixels repeated: what a GL sampler does. `at`: pixels, the first centre at 0.5.
Tap sample(const SkinImage& image, std::span<const glm::dvec4> light, glm::dvec2 at) {
    const double x = at.x - 0.5, y = at.y - 0.5;
    const double x0 = std::floor(x), y0 = std::floor(y);
    Tap tap;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double share = (dx == 0 ? 1 - (x - x0) : x - x0) * (dy == 0 ? 1 - (y - y0) : y - y0);
            const auto column = static_cast<std::size_t>(std::clamp(x0 + dx, 0.0, image.width - 1.0));
            const auto row = static_cast<std::size_t>(std::clamp(y0 + dy, 0.0, image.height - 1.0));
            const std::size_t p = row * image.width + column;
            tap.light += share * light[p];
            tap.depth_mm += share * image.depth_mm[p];
        }
    }
    return tap;
}

/// What a tap adds to the centre's colour, for a weight of 1. Light that the tap lacks, and light from another depth,
/// counts as the centre: so constant light stays as it is, bit for bit.
glm::dvec3 difference(const Tap& tap, glm::dvec3 centre, double depth_mm, double follow_mm) {
    glm::dvec3 d = glm::dvec3(tap.light) - centre * tap.light.a;
    if (follow_mm > 0 && tap.light.a > 0) {
        const double apart = std::abs(tap.depth_mm / tap.light.a - depth_mm) / follow_mm;
        d *= 1 - std::min(apart, 1.0);
    }
    return d;
}

/// Calls visit(pixel, position, matte, colour, depth) for each pixel with skin.
template <class Visit>
void each_skin_pixel(const SkinImage& image, std::span<const glm::dvec4> light, Visit visit) {
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::size_t p = std::size_t{y} * image.width + x;
            const double matte = light[p].a;
            if (!(matte > 0)) continue;
            visit(p, glm::dvec2(x + 0.5, y + 0.5), matte, glm::dvec3(light[p]) / matte, image.depth_mm[p] / matte);
        }
    }
}

std::vector<glm::dvec3> colours(const SkinImage& image, std::span<const glm::dvec4> light) {
    std::vector<glm::dvec3> result(light.size(), glm::dvec3(0));
    each_skin_pixel(image, light,
                    [&](std::size_t p, glm::dvec2, double, glm::dvec3 colour, double) { result[p] = colour; });
    return result;
}

/// Pixels a millimetre that light goes at a pixel of skin: fewer where the strength map says less (jimenez-2012, 6.3).
glm::dvec2 reach_pixels(const SkinImage& image, const ScatterProjection& projection, std::size_t p, double depth_mm) {
    const double strength = image.strength.empty() ? 1 : image.strength[p] / image.light[p].a;
    return projection.pixels_a_mm(depth_mm) * strength;
}

/// Depth's change to the next pixel in a direction, at a pixel of skin: 0 where the next one is not skin.
double gradient_mm(const SkinImage& image, std::size_t p, int direction) {
    const std::size_t x = p % image.width, y = p / image.width;
    if ((direction == 0 ? x + 1 : y + 1) >= (direction == 0 ? image.width : image.height)) return 0;
    const std::size_t next = direction == 0 ? p + 1 : p + image.width;
    if (!(image.light[next].a > 0)) return 0;
    return image.depth_mm[next] / image.light[next].a - image.depth_mm[p] / image.light[p].a;
}

}  // namespace

glm::dvec2 ScatterProjection::pixels_a_mm(double depth_mm) const {
    const double divisor = std::max(depth_mm * perspective + 1 - perspective, 1e-9);
    return glm::min(scale / divisor, glm::dvec2(most_pixels_a_mm));
}

std::vector<glm::dvec3> scatter_separable(const SkinImage& image, std::span<const KernelTap> taps,
                                          const ScatterProjection& projection, double follow_mm) {
    std::vector<glm::dvec4> light = image.light;
    for (int direction = 0; direction < 2; ++direction) {
        std::vector<glm::dvec4> next(light.size(), glm::dvec4(0));
        each_skin_pixel(image, light, [&](std::size_t p, glm::dvec2 at, double matte, glm::dvec3 centre, double depth) {
            const double scale = reach_pixels(image, projection, p, depth)[direction];
            glm::dvec3 sum = centre;
            for (const KernelTap& tap : taps) {
                if (tap.offset_mm == 0) continue;
                glm::dvec2 place = at;
                place[direction] += tap.offset_mm * scale;
                sum += tap.weight * difference(sample(image, light, place), centre, depth, follow_mm);
            }
            next[p] = {sum * matte, matte};
        });
        light = std::move(next);
    }
    return colours(image, light);
}

std::vector<glm::dvec3> scatter_gaussians(const SkinImage& image, std::span<const GaussianTerm> profile,
                                          const ScatterProjection& projection) {
    // beta and gamma of 4.2, for a head of one unit: in millimetres of a head of 240.
    constexpr double beta = 800, gamma_mm = 0.001 * 240;
    std::array<double, 7> weights{};
    double total = 0;
    for (int k = -3; k <= 3; ++k) total += weights[static_cast<std::size_t>(k + 3)] = std::exp(-0.5 * k * k);
    std::vector<glm::dvec4> light = image.light;
    std::vector<glm::dvec3> sum = colours(image, light);
    glm::dvec3 weight_so_far = profile[0].weight;
    for (std::size_t g = 1; g < profile.size(); ++g) {
        const double sigma_mm = std::sqrt(profile[g].variance_mm2 - profile[g - 1].variance_mm2);
        const auto too_narrow = [&](std::size_t p, double depth) {
            return std::sqrt(profile[g].variance_mm2) * reach_pixels(image, projection, p, depth).y <= 0.5;  // eq. 4.5
        };
        for (int direction = 0; direction < 2; ++direction) {
            std::vector<glm::dvec4> next = light;
            each_skin_pixel(
                image, light, [&](std::size_t p, glm::dvec2 at, double matte, glm::dvec3 centre, double depth) {
                    if (too_narrow(p, depth)) return;
                    const double slope = beta * std::min(std::abs(gradient_mm(image, p, direction)), gamma_mm);
                    const double scale =
                        reach_pixels(image, projection, p, depth + projection.perspective * slope)[direction] *
                        sigma_mm;
                    glm::dvec3 blurred = centre;
                    for (int k = -3; k <= 3; ++k) {
                        if (k == 0) continue;
                        glm::dvec2 place = at;
                        place[direction] += k * scale;
                        blurred += weights[static_cast<std::size_t>(k + 3)] / total *
                                   difference(sample(image, light, place), centre, depth, 0);
                    }
                    next[p] = {blurred * matte, matte};
                });
            light = std::move(next);
        }
        weight_so_far += profile[g].weight;
        const glm::dvec3 share = profile[g].weight / weight_so_far;  // eq. 4.8
        each_skin_pixel(image, light, [&](std::size_t p, glm::dvec2, double, glm::dvec3 colour, double depth) {
            if (!too_narrow(p, depth)) sum[p] = glm::mix(sum[p], colour, share);
        });
    }
    return sum;
}

JitteredKernel jittered_kernel(std::span<const GaussianTerm> profile) {
    // Where the rings part: direct light below 0.35 mm, the green and blue scattering to 1.2 mm, the red one beyond, to
    // the last hundredth of the red channel's light (7 mm). The taps stand at the rings' mean distance of red light.
    constexpr double inner = 0.35, outer = 1.2, end = 7;
    const auto ring = [profile](double from, double to) {
        JitteredRing result;
        double distance = 0, mass = 0;
        constexpr int steps = 400;
        for (int i = 0; i < steps; ++i) {
            const double r = from + (to - from) * (i + 0.5) / steps;
            const glm::dvec3 share = profile_at(profile, r) * 2.0 * std::numbers::pi * r * ((to - from) / steps);
            result.weight += share;
            distance += r * share.r;
            mass += share.r;
        }
        result.radius_mm = distance / mass;
        return result;
    };
    return {ring(inner, outer), ring(outer, end)};
}

double jitter_radians(std::uint32_t x, std::uint32_t y) {
    // A 4 x 4 ordered pattern: neighbours turn differently and a small neighbourhood evens out.
    constexpr std::array<double, 16> pattern = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return pattern[(y % 4) * 4 + x % 4] / 16 * (std::numbers::pi / 3);
}

std::vector<glm::dvec3> scatter_jittered(const SkinImage& image, const JitteredKernel& kernel,
                                         const ScatterProjection& projection, double follow_mm) {
    std::vector<glm::dvec3> result(image.light.size(), glm::dvec3(0));
    each_skin_pixel(image, image.light, [&](std::size_t p, glm::dvec2 at, double, glm::dvec3 centre, double depth) {
        const glm::dvec2 scale = reach_pixels(image, projection, p, depth);
        const double turn =
            jitter_radians(static_cast<std::uint32_t>(p % image.width), static_cast<std::uint32_t>(p / image.width));
        glm::dvec3 sum = centre;
        for (int k = 0; k < 12; ++k) {
            const JitteredRing& ring = k < 6 ? kernel.middle : kernel.wide;
            // The wide ring stands between the taps of the middle one.
            const double angle = turn + (k % 6 + (k < 6 ? 0 : 0.5)) * (std::numbers::pi / 3);
            const glm::dvec2 place = at + ring.radius_mm * scale * glm::dvec2(std::cos(angle), std::sin(angle));
            sum += ring.weight / 6.0 * difference(sample(image, image.light, place), centre, depth, follow_mm);
        }
        result[p] = sum;
    });
    return result;
}

std::vector<glm::dvec3> scatter_exact(const SkinImage& image, std::span<const GaussianTerm> profile,
                                      const ScatterProjection& projection, double follow_mm, double reach_mm,
                                      std::uint32_t every) {
    std::vector<glm::dvec3> result(image.light.size(), glm::dvec3(0));
    std::vector<std::vector<double>> across(profile.size()), down(profile.size());
    each_skin_pixel(image, image.light, [&](std::size_t p, glm::dvec2, double, glm::dvec3 centre, double depth) {
        if (p % image.width % every != 0 || p / image.width % every != 0) return;
        const glm::dvec2 scale = glm::max(reach_pixels(image, projection, p, depth), glm::dvec2(1e-6));
        const auto x = static_cast<int>(p % image.width), y = static_cast<int>(p / image.width);
        const int reach_x = static_cast<int>(std::min(std::ceil(reach_mm * scale.x), image.width * 1.0));
        const int reach_y = static_cast<int>(std::min(std::ceil(reach_mm * scale.y), image.height * 1.0));
        // A Gaussian's integral over a square is a product of two differences of the error function.
        const auto shares = [](std::vector<double>& out, int reach, double pixels_a_mm, double variance) {
            out.clear();
            const double to = 1 / (pixels_a_mm * std::sqrt(2 * variance));
            for (int i = -reach; i <= reach; ++i) {
                out.push_back(0.5 * (std::erf((i + 0.5) * to) - std::erf((i - 0.5) * to)));
            }
        };
        for (std::size_t g = 0; g < profile.size(); ++g) {
            shares(across[g], reach_x, scale.x, profile[g].variance_mm2);
            shares(down[g], reach_y, scale.y, profile[g].variance_mm2);
        }
        glm::dvec3 sum = centre;
        for (int dy = -reach_y; dy <= reach_y; ++dy) {
            for (int dx = -reach_x; dx <= reach_x; ++dx) {
                const int column = x + dx, row = y + dy;
                if (column < 0 || row < 0 || column >= static_cast<int>(image.width) ||
                    row >= static_cast<int>(image.height)) {
                    continue;
                }
                const std::size_t q = static_cast<std::size_t>(row) * image.width + static_cast<std::size_t>(column);
                if (!(image.light[q].a > 0)) continue;
                glm::dvec3 weight(0);
                for (std::size_t g = 0; g < profile.size(); ++g) {
                    weight += profile[g].weight * across[g][static_cast<std::size_t>(dx + reach_x)] *
                              down[g][static_cast<std::size_t>(dy + reach_y)];
                }
                sum += weight * difference({image.light[q], image.depth_mm[q]}, centre, depth, follow_mm);
            }
        }
        result[p] = sum;
    });
    return result;
}

}  // namespace blush
