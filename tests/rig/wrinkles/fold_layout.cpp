// The part of a texture layout that wrinkle maps show.

#include "rig/wrinkles/fold_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rig/wrinkles/wrinkle_zones.h"

namespace blush {
namespace {

/// Millimetres are the unit; the mean face's own landmarks.
CanonicalFrame mean_frame() {
    FaceLandmarks landmarks;
    landmarks.left_eye = {canonical_pupil_mm, 0, 0};
    landmarks.right_eye = {-canonical_pupil_mm, 0, 0};
    landmarks.mouth = {0, canonical_mouth_mm, 0};
    return CanonicalFrame(landmarks);
}

constexpr std::uint32_t side = 41;

/// A sheet in front of the head from 160 mm left to 160 mm right and as far up and down, `behind_mm` behind the eyes.
void add_sheet(Face& face, float behind_mm, glm::vec2 uv_from, glm::vec2 uv_to) {
    Primitive primitive;
    primitive.first_vertex = static_cast<std::uint32_t>(face.positions.size());
    primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
    primitive.vertex_count = side * side;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const glm::vec2 share = glm::vec2(i % side, i / side) / static_cast<float>(side - 1);
        face.positions.emplace_back(320 * share.x - 160, 160 - 320 * share.y, -behind_mm);
        face.uv0.push_back(glm::mix(uv_from, uv_to, share));
    }
    for (std::uint32_t y = 0; y + 1 < side; ++y) {
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = primitive.first_vertex + y * side + x;
            for (const std::uint32_t index : {a, a + side, a + 1, a + 1, a + side, a + side + 1})
                face.indices.push_back(index);
        }
    }
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size()) - primitive.first_index;
    face.primitives.push_back(primitive);
}

std::vector<std::string> zones() {
    std::vector<std::string> names;
    for (const WrinkleZonePlace& place : wrinkle_zone_places) names.emplace_back(place.name);
    return names;
}

TEST(FoldLayout, SkinBehindSkinDoesNotShow) {
    Face face;
    add_sheet(face, 0, {0, 0}, {0.5F, 1});
    add_sheet(face, 12, {0.5F, 0}, {1, 1});
    add_sheet(face, 3, {0.5F, 0}, {1, 1});
    const std::vector<std::uint32_t> all = {0, 1, 2}, hidden = {1};
    const std::vector<std::uint8_t> outer = outer_triangles(face, all, mean_frame());
    const std::size_t each = face.primitives[0].index_count / 3;
    for (std::size_t t = 0; t < each; ++t) {
        // Far to the side the sheets are seen along their surface.
        if (std::abs(face.positions[face.indices[3 * t]].x) > 60) continue;
        EXPECT_EQ(outer[t], 1) << t;
        EXPECT_EQ(outer[each + t], 0) << t;
        EXPECT_EQ(outer[2 * each + t], 1) << "no more than a fold of skin deep";
    }
    // A lining: skin that faces the axis.
    Face turned = face;
    for (std::size_t t = 0; t < each; ++t) std::swap(turned.indices[3 * t], turned.indices[3 * t + 1]);
    const std::vector<std::uint32_t> first = {0};
    const std::vector<std::uint8_t> lining = outer_triangles(turned, first, mean_frame());
    EXPECT_EQ(std::ranges::count(lining, 1), 0);
    const std::vector<std::uint8_t> alone = outer_triangles(face, hidden, mean_frame());
    for (std::size_t t = 0; t < each; ++t) {
        if (std::abs(face.positions[face.indices[3 * t]].x) > 60) continue;
        EXPECT_EQ(alone[t], 0) << "not asked for";
        EXPECT_EQ(alone[each + t], 1) << "nothing before it";
    }
}

TEST(FoldLayout, ThePartHoldsEveryZoneAndLittleElse) {
    Face face;
    add_sheet(face, 0, {0, 0}, {1, 1});
    const std::vector<std::uint32_t> all = {0};
    const CanonicalFrame frame = mean_frame();
    const std::vector<std::uint8_t> triangles(face.indices.size() / 3, 1);
    const LayoutPart part = part_of_zones(face, triangles, frame, zones());
    EXPECT_FALSE(part.is_whole());
    const glm::vec2 size = part.to - part.from;
    EXPECT_LT(size.x * size.y, 0.45F);
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        if (!in_a_zone(zones(), frame.canonical_mm(face.positions[v]))) continue;
        const glm::vec2 uv = part.within(face.uv0[v]);
        EXPECT_TRUE(uv.x > 0.02F && uv.x < 0.98F && uv.y > 0.02F && uv.y < 0.98F) << v;
    }
}

TEST(FoldLayout, AFewTrianglesElsewhereDoNotWidenThePart) {
    Face face;
    add_sheet(face, 0, {0, 0}, {0.8F, 0.8F});
    const CanonicalFrame frame = mean_frame();
    std::vector<std::uint8_t> triangles(face.indices.size() / 3, 1);
    const LayoutPart part = part_of_zones(face, triangles, frame, zones());
    EXPECT_FALSE(part.is_whole());
    // The rim of a lip's inside, at a corner of the mouth, in a chart of its own.
    const auto corner = static_cast<std::uint32_t>(face.positions.size());
    for (const glm::vec2 uv : {glm::vec2(0.95F, 0.95F), glm::vec2(0.96F, 0.95F), glm::vec2(0.95F, 0.96F)}) {
        face.positions.emplace_back(27, -66, 0);
        face.uv0.push_back(uv);
    }
    for (std::uint32_t c = 0; c < 3; ++c) face.indices.push_back(corner + c);
    triangles.push_back(1);
    EXPECT_EQ(part_of_zones(face, triangles, frame, zones()), part);
}

TEST(FoldLayout, TheWholeLayoutWhereThePartIsUnknown) {
    Face face;
    add_sheet(face, 0, {0, 0}, {1, 1});
    const std::vector<std::uint8_t> triangles(face.indices.size() / 3, 1), none(face.indices.size() / 3, 0);
    EXPECT_TRUE(part_of_zones(face, none, mean_frame(), zones()).is_whole());
    EXPECT_TRUE(part_of_zones(face, triangles, mean_frame(), std::vector<std::string>{"elbow"}).is_whole());
    Face beyond = face;
    for (glm::vec2& uv : beyond.uv0) uv += glm::vec2(1, 0);
    EXPECT_TRUE(part_of_zones(beyond, triangles, mean_frame(), zones()).is_whole()) << "it repeats";
    beyond.uv0.clear();
    EXPECT_TRUE(part_of_zones(beyond, triangles, mean_frame(), zones()).is_whole());
}

TEST(FoldLayout, PlacesFarAwayAndOddOnesEnd) {
    for (const float odd : {1e30F, -1e30F, std::numeric_limits<float>::infinity(), std::nanf("")}) {
        for (int axis = 0; axis < 3; ++axis) {
            Face face;
            add_sheet(face, 0, {0, 0}, {1, 1});
            face.positions[side * side / 2][axis] = odd;
            const std::vector<std::uint32_t> all = {0};
            const CanonicalFrame frame = mean_frame();
            const std::vector<std::uint8_t> outer = outer_triangles(face, all, frame);
            const LayoutPart part = part_of_zones(face, outer, frame, zones());
            EXPECT_LT(part.from.x, part.to.x);
            EXPECT_LT(part.from.y, part.to.y);
        }
    }
}

TEST(FoldLayout, CroppingKeepsSurfaceAndMovesTextureCoordinates) {
    Face face;
    add_sheet(face, 0, {0, 0}, {1, 1});
    std::vector<std::uint8_t> triangles(face.indices.size() / 3, 1);
    const Face same = cropped(face, triangles, {});
    EXPECT_EQ(same.indices, face.indices);
    EXPECT_EQ(same.uv0, face.uv0);
    const LayoutPart middle{{0.25F, 0.25F}, {0.75F, 0.75F}};
    const Face part = cropped(face, triangles, middle);
    EXPECT_EQ(part.positions, face.positions);
    EXPECT_NEAR(static_cast<double>(part.indices.size()), 0.25 * static_cast<double>(face.indices.size()),
                0.01 * static_cast<double>(face.indices.size()));
    EXPECT_EQ(part.uv0[side * side / 2], glm::vec2(0.5F));
    EXPECT_EQ(part.uv0[0], glm::vec2(-0.5F));
    triangles.assign(triangles.size(), 0);
    EXPECT_TRUE(cropped(face, triangles, {}).indices.empty());
}

}  // namespace
}  // namespace blush
