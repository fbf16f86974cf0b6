// The UV layout as bakers see it.

#include "rig/wrinkles/uv_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

/// A square of two triangles that fills the middle half of the unit square of UV.
Face half_square() {
    Face face;
    face.uv0 = {{0.25F, 0.25F}, {0.75F, 0.25F}, {0.75F, 0.75F}, {0.25F, 0.75F}};
    face.uv1 = face.uv0;
    face.indices = {0, 1, 2, 0, 2, 3};
    face.primitives.push_back({.vertex_count = 4, .index_count = 6});
    face.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    return face;
}

const std::vector<std::uint8_t> all = {1};

TEST(UvRaster, CoversEachTexelOfASquareOnce) {
    const Face face = half_square();
    const UvRaster raster = rasterize_uv(face, all, 0, 8, 8);
    EXPECT_EQ(raster.overlaps, 0U);
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 8; ++x) {
            const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
            EXPECT_EQ(raster.covered(y * 8 + x), inside) << x << ", " << y;
            if (!inside) continue;
            const glm::vec3 at = raster.interpolate<glm::vec3>(face, y * 8 + x, face.positions);
            EXPECT_NEAR(at.x, (static_cast<float>(x) + 0.5F - 2) / 2, 1e-6F);
            EXPECT_NEAR(at.y, (static_cast<float>(y) + 0.5F - 2) / 2, 1e-6F);
        }
    }
}

TEST(UvRaster, MirroredAndRepeatedChartsCount) {
    Face face = half_square();
    for (glm::vec2& uv : face.uv0) uv = {3.0F - uv.x, uv.y - 2.0F};
    const UvRaster raster = rasterize_uv(face, all, 0, 8, 8);
    EXPECT_EQ(std::ranges::count_if(raster.texels, [](const UvTexel& t) { return t.triangle != UvTexel::none; }), 16);
}

TEST(UvRaster, OverlapsAreCounted) {
    Face face = half_square();
    face.indices.insert(face.indices.end(), {0, 1, 2});
    face.primitives[0].index_count = 9;
    EXPECT_GT(rasterize_uv(face, all, 0, 8, 8).overlaps, 0U);
}

TEST(UvRaster, NothingToCover) {
    Face face = half_square();
    EXPECT_TRUE(nearest_covered(rasterize_uv(face, std::vector<std::uint8_t>{0}, 0, 4, 4)).empty());
    std::ranges::fill(face.uv0, glm::vec2(0.5F));
    EXPECT_TRUE(nearest_covered(rasterize_uv(face, all, 0, 4, 4)).empty());
    std::ranges::fill(face.uv0, glm::vec2(std::nanf("")));
    EXPECT_TRUE(nearest_covered(rasterize_uv(face, all, 0, 4, 4)).empty());
    EXPECT_TRUE(rasterize_uv(face, all, 0, 0, 0).texels.empty());
}

TEST(UvRaster, TheNearestCoveredTexelIsTheNearest) {
    const UvRaster raster = rasterize_uv(half_square(), all, 0, 16, 16);
    const std::vector<std::uint32_t> nearest = nearest_covered(raster);
    ASSERT_EQ(nearest.size(), 256U);
    for (std::uint32_t i = 0; i < 256; ++i) {
        ASSERT_TRUE(raster.covered(nearest[i]));
        const auto distance2 = [&](std::uint32_t to) {
            const int dx = static_cast<int>(i % 16) - static_cast<int>(to % 16);
            const int dy = static_cast<int>(i / 16) - static_cast<int>(to / 16);
            return dx * dx + dy * dy;
        };
        int least = 1000;
        for (std::uint32_t to = 0; to < 256; ++to) {
            if (raster.covered(to)) least = std::min(least, distance2(to));
        }
        EXPECT_EQ(distance2(nearest[i]), least) << i;
    }
}

}  // namespace
}  // namespace blush
