#include "rig/blood/hemoglobin_pattern.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

float share_at(const SoftEllipse& region, glm::vec2 place) {
    const auto bell = [&](glm::vec2 at) {
        const glm::vec2 off = at - region.centre_mm;
        const float c = std::cos(region.angle_radians), s = std::sin(region.angle_radians);
        const glm::vec2 own = glm::vec2(c * off.x + s * off.y, c * off.y - s * off.x) / region.radii_mm;
        return std::exp(-glm::dot(own, own));
    };
    const float here = bell(place);
    // The larger of both sides, not their sum: on the midline they meet without a ridge.
    return region.mirrored ? std::max(here, bell({-place.x, place.y})) : here;
}

}  // namespace

const std::array<std::string_view, 11> hemoglobin_pattern_names = {
    "joy", "sadness", "anger", "fear", "disgust", "surprise", "exercise", "alcohol", "blush", "pallor", "cold"};

RelativeChange change_at(const HemoglobinPattern& pattern, glm::vec2 place) {
    constexpr float least = -0.95F;
    // Around the head x repeats; regions are written near the face, so the nearer turn counts.
    const float turn = CanonicalFrame::turn_mm();
    place.x -= turn * std::round(place.x / turn);
    RelativeChange change = pattern.everywhere;
    for (const SoftEllipse& region : pattern.regions) {
        const float share = share_at(region, place);
        change.mean += share * region.change.mean;
        change.deviation += share * region.change.deviation;
    }
    return {std::max(change.mean, least), std::max(change.deviation, least)};
}

HemoglobinMaps hemoglobin_maps(const AppearanceMaps& appearance, const CanonicalMap& canonical,
                               std::span<const HemoglobinPattern> patterns, const HemoglobinMapOptions& options) {
    const float radius = options.radius * static_cast<float>(appearance.hemoglobin.width);
    const LocalStatistics neutral = local_statistics(appearance.hemoglobin, radius, &appearance.skin);
    const ScalarMap mean = resized(neutral.mean, options.side, options.side);
    HemoglobinMaps maps;
    for (const HemoglobinPattern& pattern : patterns) {
        HemoglobinChange change{mean, mean};
        for (std::uint32_t y = 0; y < options.side; ++y) {
            for (std::uint32_t x = 0; x < options.side; ++x) {
                // The texel under the middle of the coarse one.
                const auto from = [&](std::uint32_t at, std::uint32_t of) {
                    return static_cast<std::uint32_t>((2 * std::uint64_t{at} + 1) * of / (2 * options.side));
                };
                const Map<glm::vec2>& places = canonical.canonical_mm;
                const glm::vec2 place = places.at(from(x, places.width), from(y, places.height));
                const HemoglobinTexel texel = transferred(change_at(pattern, place), mean.at(x, y));
                change.scale.at(x, y) = texel.scale;
                change.offset.at(x, y) = texel.offset;
            }
        }
        maps.names.push_back(pattern.name);
        maps.changes.push_back(std::move(change));
    }
    return maps;
}

}  // namespace blush
