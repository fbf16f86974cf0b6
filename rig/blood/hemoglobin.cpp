#include "rig/blood/hemoglobin.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "rig/blood/skin_colour.h"

namespace blush {
namespace {

float clamp_hemoglobin(float h) { return h > 0 ? std::min(h, static_cast<float>(largest_hemoglobin)) : 0.0F; }

float scale_of(float neutral_deviation, float deviation) {
    if (!(neutral_deviation > flat_deviation) || !(deviation >= 0)) return 1;
    return std::min(deviation / neutral_deviation, largest_hemoglobin_scale);
}

/// The finite values of a disc, sorted.
void disc_values(const ScalarMap& map, int x, int y, float radius, std::vector<float>& values) {
    const int width = static_cast<int>(map.width), height = static_cast<int>(map.height);
    values.clear();
    for (int j = 0; j < height; ++j) {
        const int half = disc_half_width(radius, j - y);
        for (int i = std::max(0, x - half); half >= 0 && i <= std::min(width - 1, x + half); ++i) {
            const float value = map.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
            if (std::isfinite(value)) values.push_back(value);
        }
    }
    std::ranges::sort(values);
}

}  // namespace

HemoglobinChange hemoglobin_change(const LocalStatistics& neutral, const LocalStatistics& expression) {
    assert(neutral.mean.same_size(expression.mean) && "hemoglobin_change: maps of two sizes");
    HemoglobinChange change{neutral.mean, neutral.mean};
    for (std::size_t i = 0; i < neutral.mean.values.size(); ++i) {
        const float scale = scale_of(neutral.deviation.values[i], expression.deviation.values[i]);
        change.scale.values[i] = scale;
        change.offset.values[i] = expression.mean.values[i] - scale * neutral.mean.values[i];
    }
    return change;
}

HemoglobinTexel transferred(const RelativeChange& change, float neutral_mean) {
    const float scale = std::clamp(1 + change.deviation, 0.0F, largest_hemoglobin_scale);
    const float mean = std::max(0.0F, 1 + change.mean) * neutral_mean;
    return {scale, mean - scale * neutral_mean};
}

RelativeChange relative_change(float neutral_mean, float neutral_deviation, float mean, float deviation) {
    return {neutral_mean > 0 ? mean / neutral_mean - 1 : 0, scale_of(neutral_deviation, deviation) - 1};
}

float blended_hemoglobin(float neutral, std::span<const float> weights, std::span<const float> scales,
                         std::span<const float> offsets, float factor) {
    assert(weights.size() == scales.size() && weights.size() == offsets.size());
    float scale = 1, offset = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        scale += weights[i] * (scales[i] - 1);
        offset += weights[i] * offsets[i];
    }
    return clamp_hemoglobin(factor * (scale * neutral + offset));
}

ScalarMap blended_hemoglobin(const ScalarMap& neutral, const ScalarMap& skin, std::span<const float> weights,
                             std::span<const HemoglobinChange> changes, float factor) {
    assert(weights.size() == changes.size() && neutral.same_size(skin));
    ScalarMap result = neutral;
    std::vector<float> active_weights, scales, offsets;
    std::vector<const HemoglobinChange*> active;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        active.push_back(&changes[i]);
        active_weights.push_back(weights[i]);
    }
    scales.resize(active.size());
    offsets.resize(active.size());
    for (std::uint32_t y = 0; y < neutral.height; ++y) {
        for (std::uint32_t x = 0; x < neutral.width; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5F) / static_cast<float>(neutral.width),
                               (static_cast<float>(y) + 0.5F) / static_cast<float>(neutral.height));
            for (std::size_t i = 0; i < active.size(); ++i) {
                scales[i] = sample(active[i]->scale, uv);
                offsets[i] = sample(active[i]->offset, uv);
            }
            const float at_rest = neutral.at(x, y), share = skin.at(x, y);
            if (share == 0) continue;
            const float changed = blended_hemoglobin(at_rest, active_weights, scales, offsets, factor);
            result.at(x, y) = share >= 1 ? changed : at_rest + share * (changed - at_rest);
        }
    }
    return result;
}

ScalarMap matched_locally(const ScalarMap& source, const ScalarMap& target, float radius) {
    assert(source.same_size(target) && "matched_locally: maps of two sizes");
    ScalarMap result = source;
    std::vector<float> from, to;
    for (std::uint32_t y = 0; y < source.height; ++y) {
        for (std::uint32_t x = 0; x < source.width; ++x) {
            const float value = source.at(x, y);
            disc_values(source, static_cast<int>(x), static_cast<int>(y), radius, from);
            disc_values(target, static_cast<int>(x), static_cast<int>(y), radius, to);
            if (!std::isfinite(value) || to.empty()) continue;
            // Percentile of the value: the middle of its run of equals, so that a flat disc stands at one half.
            const auto [first, last] = std::equal_range(from.begin(), from.end(), value);
            const double before = static_cast<double>(first - from.begin()), run = static_cast<double>(last - first);
            const double percentile = (before + run / 2) / static_cast<double>(from.size());
            const double place =
                std::clamp(percentile * static_cast<double>(to.size()) - 0.5, 0.0, static_cast<double>(to.size() - 1));
            const auto below = static_cast<std::size_t>(place);
            const std::size_t above = std::min(below + 1, to.size() - 1);
            result.at(x, y) = std::lerp(to[below], to[above], static_cast<float>(place - static_cast<double>(below)));
        }
    }
    return result;
}

}  // namespace blush
