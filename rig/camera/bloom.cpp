#include "rig/camera/bloom.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

using Picture = Map<glm::dvec3>;

constexpr double most = 60000;  // shaders/draw/face.frag: of a half float

glm::dvec3 usable(const glm::dvec3& c) {
    const auto channel = [](double v) { return v > 0 ? std::min(v, most) : 0; };  // not a number: 0
    return {channel(c.x), channel(c.y), channel(c.z)};
}

glm::dvec3 bright(const glm::dvec3& c, double threshold) {
    const double largest = std::max({c.x, c.y, c.z});
    return largest > threshold ? c * ((largest - threshold) / largest) : glm::dvec3(0);
}

Picture halved(const Picture& from) {
    Picture half((from.width + 1) / 2, (from.height + 1) / 2);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const std::uint32_t x1 = std::min(2 * x + 1, from.width - 1), y1 = std::min(2 * y + 1, from.height - 1);
            half.at(x, y) = 0.25 * (from.at(2 * x, 2 * y) + from.at(x1, 2 * y) + from.at(2 * x, y1) + from.at(x1, y1));
        }
    }
    return half;
}

glm::dvec3 enlarged(const Picture& from, std::uint32_t x, std::uint32_t y) {
    const auto other = [](std::uint32_t at, std::uint32_t size) {
        const std::uint32_t near = at / 2;
        if (at % 2 == 0) return near == 0 ? 0 : near - 1;
        return std::min(near + 1, size - 1);
    };
    const std::uint32_t x1 = other(x, from.width), y1 = other(y, from.height);
    return 0.75 * (0.75 * from.at(x / 2, y / 2) + 0.25 * from.at(x1, y / 2)) +
           0.25 * (0.75 * from.at(x / 2, y1) + 0.25 * from.at(x1, y1));
}

}  // namespace

std::uint32_t bloom_levels(double radius_of_height, std::uint32_t width, std::uint32_t height) {
    constexpr double most_levels = 8;  // a 256th: smoother than that is a constant
    const double fits = std::max(1.0, std::floor(std::log2(static_cast<double>(std::max(width, height)))));
    const double wanted = std::round(std::log2(std::max(radius_of_height * height, 1.0)));
    return static_cast<std::uint32_t>(std::clamp(wanted, 1.0, std::min(fits, most_levels)));
}

Picture bloomed(const Picture& radiance_linear, double strength, double threshold, std::uint32_t levels) {
    Picture light = radiance_linear;
    for (glm::dvec3& c : light.values) c = bright(usable(c), threshold);
    std::vector<Picture> pyramid = {light};
    for (std::uint32_t k = 0; k < levels; ++k) pyramid.push_back(halved(pyramid.back()));
    for (std::uint32_t k = levels - 1; k > 0; --k) {
        const double share = 1.0 / (levels - k + 1);  // of this level, so that each has the same in the end
        for (std::uint32_t y = 0; y < pyramid[k].height; ++y) {
            for (std::uint32_t x = 0; x < pyramid[k].width; ++x) {
                pyramid[k].at(x, y) = glm::mix(enlarged(pyramid[k + 1], x, y), pyramid[k].at(x, y), share);
            }
        }
    }
    Picture result = radiance_linear;
    for (std::uint32_t y = 0; y < result.height; ++y) {
        for (std::uint32_t x = 0; x < result.width; ++x) {
            glm::dvec3& c = result.at(x, y);
            c = usable(c) + strength * (enlarged(pyramid[1], x, y) - light.at(x, y));
        }
    }
    return result;
}

}  // namespace blush
