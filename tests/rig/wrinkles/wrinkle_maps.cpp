// Wrinkle maps from the strain of a face's own expressions.

#include "rig/wrinkles/wrinkle_maps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace blush {
namespace {

constexpr std::uint32_t grid = 33;

/// A flat sheet of 100 x 100 mm whose left half target 0 squeezes along x and whose right half target 1 squeezes along
/// y, each by 30 % and fading out towards the middle.
Face sheet() {
    Face face;
    Target along_x, along_y;
    along_x.name = "squeezeLeft";
    along_y.name = "squeezeRight";
    for (std::uint32_t i = 0; i < grid * grid; ++i) {
        const glm::vec2 uv = glm::vec2(i % grid, i / grid) / static_cast<float>(grid - 1);
        const glm::vec3 p(100 * uv.x, -100 * uv.y, 0);
        face.positions.push_back(p);
        face.normals.emplace_back(0, 0, 1);
        face.tangents.emplace_back(1, 0, 0, -1);  // v runs down the sheet
        face.uv0.push_back(uv);
        const float left = glm::smoothstep(50.0F, 40.0F, p.x), right = glm::smoothstep(50.0F, 60.0F, p.x);
        if (left > 0) {
            along_x.vertices.push_back(i);
            along_x.position_deltas.emplace_back(left * 0.3F * (40 - p.x), 0, 0);
        }
        if (right > 0) {
            along_y.vertices.push_back(i);
            along_y.position_deltas.emplace_back(0, right * 0.3F * (-50 - p.y), 0);
        }
    }
    for (std::uint32_t y = 0; y + 1 < grid; ++y) {
        for (std::uint32_t x = 0; x + 1 < grid; ++x) {
            const std::uint32_t a = y * grid + x, b = a + 1, c = a + grid, d = c + 1;
            face.indices.insert(face.indices.end(), {a, c, b, b, c, d});
        }
    }
    face.uv1 = face.uv0;
    face.targets = {along_x, along_y};
    face.primitives.push_back(
        {.vertex_count = grid * grid, .index_count = static_cast<std::uint32_t>(face.indices.size())});
    return face;
}

const std::vector<std::uint8_t> skin = {1};
const std::vector<WrinkleSource> sources = {{{1, 0}, {1, 0}}, {{0, 1}, {0, 1}}};
constexpr WrinkleBake small{.map_side = 64, .mask_side = 16, .millimetres_a_unit = 1, .spacing_mm = 10};

WrinkleMaps bake() { return bake_wrinkles(sheet(), skin, sources, small); }

TEST(WrinkleMaps, EachZoneIsWhereItsPosePressesTheSkin) {
    const WrinkleMaps maps = bake();
    ASSERT_EQ(maps.masks.size(), 2U);
    for (std::uint32_t y = 2; y < 14; ++y) {
        EXPECT_GT(maps.masks[0].values[y * 16 + 3], 0.9F);
        EXPECT_LT(maps.masks[0].values[y * 16 + 12], 0.01F);
        EXPECT_LT(maps.masks[1].values[y * 16 + 3], 0.01F);
        // Less than full: the shear where this squeeze fades out shortens the skin more.
        EXPECT_GT(maps.masks[1].values[y * 16 + 12], 0.7F);
    }
    for (std::size_t i = 0; i < maps.masks[0].values.size(); ++i)
        EXPECT_LE(maps.masks[0].values[i] + maps.masks[1].values[i], 1.0001F);
}

TEST(WrinkleMaps, FoldsRunAcrossTheCompression) {
    const WrinkleMaps maps = bake();
    const auto power = [&](std::uint32_t first_x) {
        glm::vec2 sum(0);
        for (std::uint32_t y = 8; y < 56; ++y) {
            for (std::uint32_t x = first_x; x < first_x + 16; ++x) {
                const glm::vec2 derivative = maps.derivatives.values[y * 64 + x];
                sum += derivative * derivative;
            }
        }
        return sum;
    };
    const glm::vec2 left = power(8), right = power(40);
    EXPECT_GT(left.x, 10 * left.y);
    EXPECT_GT(right.y, 10 * right.x);
}

// A displacement along +z that rises along +x tilts the normal towards -x; the derivative has no minus of its own
// (8.2).
TEST(WrinkleMaps, DerivativesAreThoseOfTheDisplacedSurface) {
    const WrinkleMaps maps = bake();
    const float texel_mm = 100.0F / 64;
    for (std::uint32_t y = 1; y < 63; ++y) {
        for (std::uint32_t x = 1; x < 63; ++x) {
            const auto height = [&](std::uint32_t u, std::uint32_t v) {
                return maps.displacement_mm.values[v * 64 + u];
            };
            const glm::vec3 along_x(2 * texel_mm, 0, height(x + 1, y) - height(x - 1, y));
            const glm::vec3 along_y(0, 2 * texel_mm, height(x, y - 1) - height(x, y + 1));
            const glm::vec3 truth = glm::normalize(glm::cross(along_x, along_y));
            const glm::vec3 tangent_space = normal_from_derivative(maps.derivatives.values[y * 64 + x]);
            // tangent +x, bitangent cross(z, x) * -1 = -y
            const glm::vec3 n(tangent_space.x, -tangent_space.y, tangent_space.z);
            ASSERT_LT(glm::distance(n, truth), 1e-4F) << x << ", " << y;
        }
    }
}

TEST(WrinkleMaps, NothingPressedNothingFolded) {
    Face face = sheet();
    for (Target& target : face.targets) {
        for (glm::vec3& delta : target.position_deltas) delta = -delta;  // stretches
    }
    const std::vector<WrinkleSource> stretch = {{{1, 0}, {1, 0}}};
    const WrinkleMaps maps = bake_wrinkles(face, skin, stretch, small);
    for (std::uint32_t y = 0; y < 16; ++y) EXPECT_LT(maps.masks[0].values[y * 16 + 2], 0.2F);
    const std::vector<WrinkleSource> smoothing = {{{1, 0}, {-1, 0}}};
    const WrinkleMaps none = bake_wrinkles(sheet(), skin, smoothing, small);
    for (const float value : none.displacement_mm.values) ASSERT_EQ(value, 0);
    for (const float value : none.masks[0].values) ASSERT_EQ(value, 0);
}

TEST(WrinkleMaps, AFaceWithoutTextureCoordinatesHasNoMaps) {
    Face face = sheet();
    for (glm::vec2& uv : face.uv0) uv = {0, 0};
    const WrinkleMaps maps = bake_wrinkles(face, skin, sources, small);
    EXPECT_EQ(maps.derivatives.values.size(), 64U * 64);
    for (const float value : maps.masks[0].values) ASSERT_EQ(value, 0);
    const WrinkleMaps left_out = bake_wrinkles(sheet(), std::vector<std::uint8_t>{0}, sources, small);
    for (const float value : left_out.displacement_mm.values) ASSERT_EQ(value, 0);
}

TEST(WrinkleMaps, SameFaceSameBits) {
    const WrinkleMaps first = bake(), second = bake();
    EXPECT_EQ(first.displacement_mm.values, second.displacement_mm.values);
    EXPECT_EQ(first.masks[0].values, second.masks[0].values);
    EXPECT_EQ(first.masks[1].values, second.masks[1].values);
}

TEST(WrinkleMaps, ScaleOfTheMeshDoesNotMatter) {
    Face face = sheet();
    for (glm::vec3& p : face.positions) p *= 0.001F;
    for (Target& target : face.targets) {
        for (glm::vec3& delta : target.position_deltas) delta *= 0.001F;
    }
    WrinkleBake metres = small;
    metres.millimetres_a_unit = 1000;
    const WrinkleMaps in_metres = bake_wrinkles(face, skin, sources, metres), in_mm = bake();
    for (std::size_t i = 0; i < in_mm.masks[0].values.size(); ++i)
        EXPECT_NEAR(in_metres.masks[0].values[i], in_mm.masks[0].values[i], 1e-3F);
}

}  // namespace
}  // namespace blush
