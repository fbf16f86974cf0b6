// Appearance transfer (jimenez-2012, 7.4.2): blood of one face's expression on another.

#include "rig/blood/appearance_transfer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

/// A face 200 mm wide and 160 high, laid out as seen from the front, or upside down.
CanonicalMap layout(bool upside_down) {
    CanonicalMap map{Map<glm::vec2>(side, side), ScalarMap(side, side, 1)};
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5F) / static_cast<float>(side);
            const glm::vec2 mm(200 * uv.x - 100, 60 - 160 * uv.y);
            map.canonical_mm.at(x, y) = upside_down ? glm::vec2(mm.x, -40 - mm.y) : mm;
        }
    }
    return map;
}

AppearanceMaps blood(float level) {
    AppearanceMaps maps;
    maps.melanin = ScalarMap(side, side, 0.02F);
    maps.hemoglobin = ScalarMap(side, side, level);
    maps.skin = ScalarMap(side, side, 1);
    maps.residual = ColourMap(side, side, glm::vec3(1));
    return maps;
}

/// 50 % more blood in a soft disc of 20 mm about a cheek at (50, -30).
HemoglobinMaps flush(const CanonicalMap& canonical, float level) {
    HemoglobinChange change{ScalarMap(side, side, 1), ScalarMap(side, side)};
    for (std::size_t i = 0; i < change.scale.values.size(); ++i) {
        const glm::vec2 off = (canonical.canonical_mm.values[i] - glm::vec2(50, -30)) / 20.0F;
        const HemoglobinTexel texel = transferred({0.5F * std::exp(-glm::dot(off, off)), 0.1F}, level);
        change.scale.values[i] = texel.scale;
        change.offset.values[i] = texel.offset;
    }
    return {{"joy"}, {change}};
}

float flushed(const HemoglobinMaps& maps, const AppearanceMaps& face, std::size_t i) {
    return maps.changes[0].scale.values[i] * face.hemoglobin.values[i] + maps.changes[0].offset.values[i];
}

TEST(AppearanceTransfer, ToTheSameFaceGivesBackItsChanges) {
    const CanonicalMap canonical = layout(false);
    const AppearanceMaps face = blood(0.02F);
    const HemoglobinMaps changes = flush(canonical, 0.02F),
                         again = transferred_maps(changes, {face, canonical}, {face, canonical});
    ASSERT_EQ(again.names, changes.names);
    // The mean face has cells of 2 mm and the map texels of 3 mm; the steepest change is 2 % of blood's level a mm.
    for (std::size_t i = 0; i < side * side; ++i) {
        EXPECT_NEAR(flushed(again, face, i), flushed(changes, face, i), 0.0015F) << i;
        EXPECT_NEAR(again.changes[0].scale.values[i], 1.1F, 1e-4F);
    }
}

TEST(AppearanceTransfer, CarriesTheShareToAnotherLayoutAndLevel) {
    const CanonicalMap from = layout(false), to = layout(true);
    const AppearanceMaps pale = blood(0.01F), ruddy = blood(0.03F);
    const HemoglobinMaps on_other = transferred_maps(flush(from, 0.01F), {pale, from}, {ruddy, to});
    const auto at = [&](glm::vec2 mm) {
        const glm::vec2 uv((mm.x + 100) / 200, (60 - (-40 - mm.y)) / 160);
        const auto texel = [](float share) { return static_cast<std::size_t>(share * side); };
        return flushed(on_other, ruddy, texel(uv.y) * side + texel(uv.x));
    };
    EXPECT_NEAR(at({50, -30}), 0.03F * 1.5F, 0.03F * 0.03F) << "half as much blood again, of its own";
    EXPECT_NEAR(at({-50, -30}), 0.03F, 0.03F * 0.01F) << "the other cheek stays";
    EXPECT_NEAR(at({50, 40}), 0.03F, 0.03F * 0.01F);
}

TEST(AppearanceTransfer, BloodlessFacesStayFinite) {
    const CanonicalMap canonical = layout(false);
    const AppearanceMaps none = blood(0), some = blood(0.02F);
    for (const auto& [from, to] : {std::pair(&none, &some), std::pair(&some, &none), std::pair(&none, &none)}) {
        const HemoglobinMaps maps = transferred_maps(flush(canonical, 0.02F), {*from, canonical}, {*to, canonical});
        for (std::size_t i = 0; i < side * side; ++i) ASSERT_TRUE(std::isfinite(flushed(maps, *to, i)));
    }
}

}  // namespace
}  // namespace blush
