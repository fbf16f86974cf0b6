#include "rig/map.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

template <class T>
T sample_map(const Map<T>& map, glm::vec2 uv) {
    const auto place = [](float coordinate, std::uint32_t size, std::uint32_t& first, std::uint32_t& second) {
        const float last = static_cast<float>(size - 1);
        const float at = std::clamp(coordinate * static_cast<float>(size) - 0.5F, 0.0F, last);
        first = static_cast<std::uint32_t>(at);
        second = std::min(first + 1, size - 1);
        return at - static_cast<float>(first);
    };
    std::uint32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    const float s = place(uv.x, map.width, x0, x1), t = place(uv.y, map.height, y0, y1);
    const T top = map.at(x0, y0) * (1 - s) + map.at(x1, y0) * s;
    const T bottom = map.at(x0, y1) * (1 - s) + map.at(x1, y1) * s;
    return top * (1 - t) + bottom * t;
}

/// The old texels that a new one covers, and the share of each.
struct Cover {
    std::uint32_t first = 0;
    std::vector<double> shares;
};
std::vector<Cover> covers(std::uint32_t from, std::uint32_t to) {
    std::vector<Cover> result(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        const double begin = static_cast<double>(i) * from / to, end = static_cast<double>(i + 1) * from / to;
        result[i].first = std::min(static_cast<std::uint32_t>(begin), from - 1);
        for (std::uint32_t k = result[i].first; k < from && k < end; ++k) {
            result[i].shares.push_back(std::min<double>(end, k + 1) - std::max<double>(begin, k));
        }
    }
    return result;
}

/// `weight_at(x, y)` of each old texel; `Wide` is T in double precision.
template <class Wide, class T, class Weight>
Map<T> area_means(const Map<T>& map, std::uint32_t width, std::uint32_t height, const Weight& weight_at) {
    const std::vector<Cover> columns = covers(map.width, width), rows = covers(map.height, height);
    Map<T> result(width, height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            Wide weighted(0), plain(0);
            double weights = 0, area = 0;
            for (std::uint32_t j = 0; j < rows[y].shares.size(); ++j) {
                for (std::uint32_t i = 0; i < columns[x].shares.size(); ++i) {
                    const std::uint32_t from_x = columns[x].first + i, from_y = rows[y].first + j;
                    const double share = rows[y].shares[j] * columns[x].shares[i];
                    const double weight = share * weight_at(from_x, from_y);
                    const Wide value(map.at(from_x, from_y));
                    weighted += weight * value;
                    plain += share * value;
                    weights += weight;
                    area += share;
                }
            }
            result.at(x, y) = weights > 0 ? T(weighted / weights) : T(plain / area);
        }
    }
    return result;
}

constexpr auto everywhere_one = [](std::uint32_t, std::uint32_t) { return 1.0; };

}  // namespace

float sample(const ScalarMap& map, glm::vec2 uv) { return sample_map(map, uv); }
glm::vec3 sample(const ColourMap& map, glm::vec2 uv) { return sample_map(map, uv); }

ScalarMap resized(const ScalarMap& map, std::uint32_t width, std::uint32_t height) {
    return area_means<double>(map, width, height, everywhere_one);
}

ColourMap resized(const ColourMap& map, std::uint32_t width, std::uint32_t height) {
    return area_means<glm::dvec3>(map, width, height, everywhere_one);
}

ScalarMap resized(const ScalarMap& map, const ScalarMap& weights, std::uint32_t width, std::uint32_t height) {
    return area_means<double>(map, width, height,
                              [&](std::uint32_t x, std::uint32_t y) { return static_cast<double>(weights.at(x, y)); });
}

}  // namespace blush
