#include "rig/wrinkles/wrinkle_zones.h"

#include <algorithm>

namespace blush {
namespace {

/// Full within this share of the radius.
constexpr float solid_share = 0.45F;

struct FromLine {
    float away_mm = 0, side_mm = 0;  ///< distance from the segment; signed distance from its line
};
FromLine from_line(const WrinkleZonePlace& place, glm::vec2 at) {
    if (place.name.ends_with("Right")) at.x = -at.x;
    const glm::vec2 along = place.to_mm - place.from_mm, off = at - place.from_mm;
    const float length2 = glm::dot(along, along);
    const float share = std::clamp(glm::dot(off, along) / length2, 0.0F, 1.0F);
    return {glm::distance(off, along * share), (along.x * off.y - along.y * off.x) / std::sqrt(length2)};
}

}  // namespace

constinit const std::array<WrinkleZonePlace, 12> wrinkle_zone_places = {{
    {"foreheadOuterLeft", {31, 42}, {46, 41}, 19},   // red
    {"foreheadOuterRight", {31, 42}, {46, 41}, 19},  // green
    {"foreheadInnerLeft", {8, 43}, {16, 43}, 20},    // blue
    {"foreheadInnerRight", {8, 43}, {16, 43}, 20},   // brown
    {"noseLeft", {6, 0}, {11, -20}, 9},              // cyan
    {"noseRight", {6, 0}, {11, -20}, 9},             // magenta
    {"glabella", {0, 4}, {0, 24}, 13},               // orange
    {"chin", {-10, -94}, {10, -94}, 14},             // gray
    {"crowsFeetLeft", {58, 6}, {60, -8}, 13},
    {"crowsFeetRight", {58, 6}, {60, -8}, 13},
    {"nasolabialLeft", {18, -37}, {33, -70}, 9, true},
    {"nasolabialRight", {18, -37}, {33, -70}, 9, true},
}};

bool in_a_zone(std::span<const std::string> zones, glm::vec2 canonical_mm) {
    return std::ranges::any_of(wrinkle_zone_places, [&](const WrinkleZonePlace& place) {
        return from_line(place, canonical_mm).away_mm < place.radius_mm &&
               std::ranges::find(zones, place.name) != zones.end();
    });
}

std::vector<WrinkleZoneField> wrinkle_zone_fields(std::span<const std::string> zones, const CanonicalMap& map) {
    const std::uint32_t width = map.canonical_mm.width, height = map.canonical_mm.height;
    std::vector<WrinkleZoneField> fields(zones.size());
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const auto place = std::ranges::find(wrinkle_zone_places, zones[z], &WrinkleZonePlace::name);
        if (place == wrinkle_zone_places.end()) continue;
        fields[z].share = ScalarMap(width, height);
        if (place->crease) fields[z].crease_mm = ScalarMap(width, height);
        for (std::size_t i = 0; i < map.canonical_mm.values.size(); ++i) {
            const FromLine from = from_line(*place, map.canonical_mm.values[i]);
            fields[z].share.values[i] = 1 - glm::smoothstep(solid_share, 1.0F, from.away_mm / place->radius_mm);
            if (place->crease) fields[z].crease_mm.values[i] = from.side_mm;
        }
    }
    return fields;
}

}  // namespace blush
