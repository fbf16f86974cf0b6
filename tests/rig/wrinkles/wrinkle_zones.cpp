// Where zones of wrinkles lie on the mean face.

#include "rig/wrinkles/wrinkle_zones.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace blush {
namespace {

constexpr std::uint32_t side = 128;
constexpr float half_mm = 80;

/// The mean face from 80 mm left of the midline to 80 mm right of it, from 80 mm above the eyes to 80 below and more.
CanonicalMap front() {
    CanonicalMap map{Map<glm::vec2>(side, side), ScalarMap(side, side, 1)};
    for (std::uint32_t i = 0; i < side * side; ++i)
        map.canonical_mm.values[i] =
            (glm::vec2(i % side, i / side) + 0.5F) * (2 * half_mm / side) - glm::vec2(half_mm, half_mm + 30);
    return map;
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const WrinkleZonePlace& place : wrinkle_zone_places) all.emplace_back(place.name);
    return all;
}

float at(const ScalarMap& map, glm::vec2 mm) {
    return sample(map, (mm + glm::vec2(half_mm, half_mm + 30)) / (2 * half_mm));
}

TEST(WrinkleZones, LieWhereTheFaceHasThem) {
    const std::vector<std::string> zones = names();
    const std::vector<WrinkleZoneField> fields = wrinkle_zone_fields(zones, front());
    const auto share = [&](std::string_view zone, glm::vec2 mm) {
        const auto found = std::ranges::find(zones, zone);
        return at(fields[static_cast<std::size_t>(found - zones.begin())].share, mm);
    };
    EXPECT_GT(share("crowsFeetLeft", {58, 0}), 0.95F);
    EXPECT_GT(share("crowsFeetRight", {-58, 0}), 0.95F);
    EXPECT_GT(share("foreheadInnerLeft", {12, 40}), 0.95F);
    EXPECT_GT(share("glabella", {0, 15}), 0.95F);
    EXPECT_GT(share("nasolabialRight", {-25, -53}), 0.9F);
    EXPECT_GT(share("chin", {0, -94}), 0.95F);
    // Bunny lines end where the cheek begins; no zone is on the eyes, the lips or the middle of a cheek.
    for (const std::string& zone : zones) {
        for (const float x_sign : {-1.0F, 1.0F}) {
            EXPECT_EQ(share(zone, {x_sign * 31, 0}), 0) << zone;
            EXPECT_EQ(share(zone, {x_sign * 10, -68}), 0) << zone;
            EXPECT_EQ(share(zone, {x_sign * 45, -38}), 0) << zone;
        }
    }
}

TEST(WrinkleZones, SidesMirrorEachOther) {
    const std::vector<std::string> zones = names();
    const std::vector<WrinkleZoneField> fields = wrinkle_zone_fields(zones, front());
    for (std::size_t z = 0; z < zones.size(); ++z) {
        std::string other = zones[z];
        if (const auto right = other.find("Right"); right != std::string::npos)
            other.replace(right, 5, "Left");
        else if (const auto left = other.find("Left"); left != std::string::npos)
            other.replace(left, 4, "Right");
        const auto mirrored = static_cast<std::size_t>(std::ranges::find(zones, other) - zones.begin());
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const std::uint32_t across = i / side * side + (side - 1 - i % side);
            ASSERT_NEAR(fields[z].share.values[i], fields[mirrored].share.values[across], 1e-4F) << zones[z];
        }
    }
}

TEST(WrinkleZones, ACreaseHasItsCheekOnTheFarSide) {
    const std::vector<std::string> zones = {"nasolabialLeft", "nasolabialRight", "chin"};
    const std::vector<WrinkleZoneField> fields = wrinkle_zone_fields(zones, front());
    EXPECT_GT(at(fields[0].crease_mm, {32, -53}), 3);
    EXPECT_LT(at(fields[0].crease_mm, {20, -53}), -3);
    EXPECT_GT(at(fields[1].crease_mm, {-32, -53}), 3);
    EXPECT_TRUE(fields[2].crease_mm.values.empty());
}

TEST(WrinkleZones, NamesThatNobodyKnowsAreEverywhere) {
    const std::vector<std::string> zones = {"elbow"};
    EXPECT_TRUE(wrinkle_zone_fields(zones, front())[0].share.values.empty());
}

}  // namespace
}  // namespace blush
