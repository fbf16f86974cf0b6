#include "rig/blood/local_statistics.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

struct Sums {
    double weight = 0, value = 0, square = 0;
    void add(const Sums& more, double sign = 1) {
        weight += sign * more.weight;
        value += sign * more.value;
        square += sign * more.square;
    }
};

/// One texel's part of the sums, about `origin`.
Sums part_of(const ScalarMap& map, const ScalarMap* weights, std::size_t i, double origin) {
    const float value = map.values[i];
    const float weight = weights ? weights->values[i] : 1.0F;
    if (!std::isfinite(value) || !(weight > 0) || !std::isfinite(weight)) return {};
    const double w = static_cast<double>(weight), v = static_cast<double>(value) - origin;
    return {w, w * v, w * v * v};
}

double origin_of(const ScalarMap& map, const ScalarMap* weights) {
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (part_of(map, weights, i, 0).weight > 0) return static_cast<double>(map.values[i]);
    }
    return 0;
}

struct Moments {
    float mean = 0, deviation = 0;
};
Moments moments_of(const Sums& sums, double origin) {
    const double mean = sums.value / sums.weight;
    const double variance = std::max(0.0, sums.square / sums.weight - mean * mean);  // rounding can leave -1e-17
    return {static_cast<float>(origin + mean), static_cast<float>(std::sqrt(variance))};
}

Sums whole(const ScalarMap& map, const ScalarMap* weights, double origin) {
    Sums all;
    for (std::size_t i = 0; i < map.values.size(); ++i) all.add(part_of(map, weights, i, origin));
    return all;
}

/// The radius as rows to go through: no farther than the map reaches.
int reach(float radius, const ScalarMap& map) {
    const auto farthest = static_cast<float>(std::max(map.width, map.height));
    return radius > 0 ? static_cast<int>(std::min(radius, 2 * farthest)) : 0;
}

}  // namespace

int disc_half_width(float radius, int row) {
    if (!(radius > 0)) return row == 0 ? 0 : -1;
    const double r = std::min(static_cast<double>(radius), 1e6), y = row;
    return y * y > r * r ? -1 : static_cast<int>(std::sqrt(r * r - y * y));
}

LocalStatistics local_statistics(const ScalarMap& map, float radius, const ScalarMap* weights) {
    LocalStatistics result{ScalarMap(map.width, map.height), ScalarMap(map.width, map.height)};
    if (map.values.empty()) return result;
    const double origin = origin_of(map, weights);
    const Sums all = whole(map, weights, origin);
    const Moments fallback = all.weight > 0 ? moments_of(all, origin) : Moments{};

    // prefix[y][x]: sums of the row's texels left of x.
    const std::size_t stride = std::size_t{map.width} + 1;
    std::vector<Sums> prefix(stride * map.height);
    for (std::size_t y = 0; y < map.height; ++y) {
        for (std::size_t x = 0; x < map.width; ++x) {
            Sums& next = prefix[y * stride + x + 1];
            next = prefix[y * stride + x];
            next.add(part_of(map, weights, y * map.width + x, origin));
        }
    }
    const int rows = reach(radius, map), height = static_cast<int>(map.height), width = static_cast<int>(map.width);
    std::vector<Sums> row_sums(map.width);
    for (int y = 0; y < height; ++y) {
        std::ranges::fill(row_sums, Sums{});
        for (int row = std::max(-rows, -y); row <= std::min(rows, height - 1 - y); ++row) {
            const int half = disc_half_width(radius, row);
            if (half < 0) continue;
            const Sums* const line = &prefix[static_cast<std::size_t>(y + row) * stride];
            for (int x = 0; x < width; ++x) {
                const auto index = static_cast<std::size_t>(x);
                row_sums[index].add(line[std::min(x + half + 1, width)]);
                row_sums[index].add(line[std::max(x - half, 0)], -1);
            }
        }
        // Differences of running sums leave rounding of the order of 1e-16 of the row's own.
        constexpr double least_weight = 1e-9;
        for (std::size_t x = 0; x < map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
            const bool any = row_sums[x].weight > least_weight;
            const Moments moments = any ? moments_of(row_sums[x], origin) : Moments{fallback.mean, 0};
            result.mean.values[i] = moments.mean;
            result.deviation.values[i] = moments.deviation;
        }
    }
    return result;
}

LocalStatistics local_statistics_by_definition(const ScalarMap& map, float radius, const ScalarMap* weights) {
    LocalStatistics result{ScalarMap(map.width, map.height), ScalarMap(map.width, map.height)};
    if (map.values.empty()) return result;
    const double origin = origin_of(map, weights);
    const Sums all = whole(map, weights, origin);
    const Moments fallback = all.weight > 0 ? moments_of(all, origin) : Moments{};
    const int width = static_cast<int>(map.width), height = static_cast<int>(map.height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Sums sums;
            for (int j = 0; j < height; ++j) {
                const int half = disc_half_width(radius, j - y);
                for (int i = std::max(0, x - half); half >= 0 && i <= std::min(width - 1, x + half); ++i) {
                    sums.add(part_of(map, weights, static_cast<std::size_t>(j * width + i), origin));
                }
            }
            const Moments moments = sums.weight > 0 ? moments_of(sums, origin) : Moments{fallback.mean, 0};
            result.mean.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) = moments.mean;
            result.deviation.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) = moments.deviation;
        }
    }
    return result;
}

}  // namespace blush
