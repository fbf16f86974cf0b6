#include "rig/head/canonical_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rig/blood/hemoglobin_pattern.h"
#include "rig/controls/rig.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

/// A dome whose targets move what they are named after: eyes at (+-0.3, 0.2), mouth at (0, -0.4).
Face small_face() {
    test::FaceOptions options;
    options.targets = 0;
    options.side = 41;
    Face face = test::make_face(options);
    const auto add = [&](const char* name, glm::vec2 at) {
        float height = 0;
        for (const glm::vec3 p : face.positions) {
            if (glm::length(glm::vec2(p) - at) < 0.05F) height = p.z;
        }
        face.targets.push_back(test::bulge(face, name, glm::vec3(at, height), 0.15F, {0, -0.05F, 0}));
    };
    add("eyeBlink_L", {0.3F, 0.2F});
    add("eyeBlink_R", {-0.3F, 0.2F});
    add("mouthSmile_L", {0.2F, -0.4F});
    add("mouthSmile_R", {-0.2F, -0.4F});
    return face;
}

TEST(CanonicalFace, FindsEyesAndMouthByWhatTargetsMove) {
    const Face face = small_face();
    const auto skin = skin_primitives(face);
    ASSERT_EQ(skin.size(), 1U);
    const auto landmarks = landmarks_from_targets(face, skin);
    ASSERT_TRUE(landmarks.has_value());
    EXPECT_NEAR(landmarks->left_eye.x, 0.3F, 0.03F);
    EXPECT_NEAR(landmarks->left_eye.y, 0.2F, 0.03F);
    EXPECT_NEAR(landmarks->right_eye.x, -0.3F, 0.03F);
    EXPECT_NEAR(landmarks->mouth.y, -0.4F, 0.03F);
    EXPECT_NEAR(landmarks->mouth.x, 0, 0.01F);
}

TEST(CanonicalFace, LandmarksStandWhereTheyBelong) {
    const Face face = small_face();
    const auto landmarks = landmarks_from_targets(face, skin_primitives(face));
    ASSERT_TRUE(landmarks.has_value());
    const CanonicalFrame frame(*landmarks);
    const glm::vec2 left = frame.canonical_mm(landmarks->left_eye), right = frame.canonical_mm(landmarks->right_eye);
    EXPECT_NEAR(left.x, canonical_pupil_mm, 1e-3F);
    EXPECT_NEAR(right.x, -canonical_pupil_mm, 1e-3F);
    EXPECT_NEAR(left.y, landmarks->eye_height_mm, 1e-3F);
    EXPECT_NEAR(frame.canonical_mm(landmarks->mouth).y, landmarks->mouth_height_mm, 1e-3F);
    // The frame goes with the face, however it is turned, scaled and placed.
    const glm::mat3 turn(glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0));
    const auto placed = [&](glm::vec3 p) { return 30.0F * (turn * p) + glm::vec3(5, -7, 100); };
    const CanonicalFrame turned({placed(landmarks->left_eye), placed(landmarks->right_eye), placed(landmarks->mouth),
                                 landmarks->eye_height_mm, landmarks->mouth_height_mm});
    for (const glm::vec3 p : face.positions) {
        EXPECT_LT(glm::length(frame.canonical_mm(p) - turned.canonical_mm(placed(p))), 0.02F);
    }
}

TEST(CanonicalFace, WithoutTargetsThereAreNoLandmarks) {
    test::FaceOptions options;
    const Face face = test::make_face(options);
    EXPECT_TRUE(skin_primitives(face).empty());
    EXPECT_FALSE(landmarks_from_targets(face, {}).has_value());
    EXPECT_FALSE(CanonicalFrame({glm::vec3(0), glm::vec3(0), glm::vec3(0, -1, 0)}).usable());
    EXPECT_FALSE(CanonicalFrame({glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0)}).usable());
    EXPECT_FALSE(CanonicalFrame({glm::vec3(std::nanf("")), glm::vec3(0), glm::vec3(0, -1, 0)}).usable());
}

TEST(CanonicalFace, TheMapIsTheGeometryInItsTexture) {
    const Face face = small_face();
    const auto skin = skin_primitives(face);
    const CanonicalFrame frame(*landmarks_from_targets(face, skin));
    const auto map = canonical_map(face, skin, frame, 64, 64);
    ASSERT_TRUE(map.has_value());
    // The dome's texture is its own plan: u = (x + 1) / 2, v = (y + 1) / 2, and it covers all of it.
    for (const float covered : map->coverage.values) EXPECT_EQ(covered, 1);
    for (std::size_t v = 0; v < face.positions.size(); v += 7) {
        if (glm::any(glm::greaterThan(glm::abs(face.uv0[v] - 0.5F), glm::vec2(0.49F)))) continue;
        const glm::vec2 uv = face.uv0[v] * 64.0F;
        const glm::vec2 there =
            map->canonical_mm.at(static_cast<std::uint32_t>(uv.x), static_cast<std::uint32_t>(uv.y));
        EXPECT_LT(glm::length(there - frame.canonical_mm(face.positions[v])), 8) << v;  // two texels
    }
}

TEST(CanonicalFace, EmptyTexelsTakeTheNearest) {
    Face face = small_face();
    for (glm::vec2& uv : face.uv0) uv *= 0.25F;
    const auto skin = skin_primitives(face);
    const auto map = canonical_map(face, skin, CanonicalFrame(*landmarks_from_targets(face, skin)), 32, 32);
    ASSERT_TRUE(map.has_value());
    EXPECT_EQ(map->coverage.at(20, 20), 0);
    EXPECT_EQ(map->canonical_mm.at(20, 3), map->canonical_mm.at(7, 3));
    for (glm::vec2& uv : face.uv0) uv = {0, 0};
    EXPECT_FALSE(canonical_map(face, skin, CanonicalFrame(*landmarks_from_targets(face, skin)), 32, 32).has_value());
    for (glm::vec2& uv : face.uv0) uv *= 1e30F;
    face.uv0[3] = {1e30F, -1e30F};
    EXPECT_FALSE(canonical_map(face, skin, CanonicalFrame(*landmarks_from_targets(face, skin)), 32, 32).has_value());
}

TEST(CanonicalFace, LayoutsOfATextureMayBeTurned) {
    const auto map = canonical_map(TextureLandmarks{{0.4F, 0.6F}, {0.4F, 0.2F}, {0.7F, 0.4F}}, 50, 50);
    ASSERT_TRUE(map.has_value());
    const auto at = [&](glm::vec2 uv) {
        return map->canonical_mm.at(static_cast<std::uint32_t>(uv.x * 50), static_cast<std::uint32_t>(uv.y * 50));
    };
    EXPECT_LT(glm::length(at({0.4F, 0.6F}) - glm::vec2(31, 0)), 4);
    EXPECT_LT(glm::length(at({0.4F, 0.2F}) - glm::vec2(-31, 0)), 4);
    EXPECT_LT(glm::length(at({0.7F, 0.4F}) - glm::vec2(0, -68)), 4);
    EXPECT_FALSE(canonical_map(TextureLandmarks{{0, 0}, {1, 1}, {0.5F, 0.5F}}, 8, 8).has_value());
}

TEST(CanonicalFace, MapsAreCarriedToAnotherLayout) {
    const auto one = canonical_map(TextureLandmarks{{0.6F, 0.4F}, {0.4F, 0.4F}, {0.5F, 0.6F}}, 96, 96);
    const auto other = canonical_map(TextureLandmarks{{0.4F, 0.6F}, {0.4F, 0.4F}, {0.6F, 0.5F}}, 80, 80);
    ScalarMap values(96, 96);
    const auto field = [](glm::vec2 mm) {
        return std::exp(-glm::dot(mm - glm::vec2(40, -30), mm - glm::vec2(40, -30)) / 900);
    };
    for (std::size_t i = 0; i < values.values.size(); ++i) values.values[i] = field(one->canonical_mm.values[i]);
    const ScalarMap there = carried(values, *one, *other);
    for (std::size_t i = 0; i < there.values.size(); ++i) {
        const glm::vec2 mm = other->canonical_mm.values[i];
        if (std::abs(mm.x) < 120 && mm.y > -120 && mm.y < 120) {
            EXPECT_NEAR(there.values[i], field(mm), 0.1F);
        }
    }
}

HemoglobinPattern cheeks() {
    HemoglobinPattern pattern;
    pattern.name = "blush";
    pattern.everywhere = {0.1F, 0.05F};
    SoftEllipse cheek;
    cheek.centre_mm = {50, -30};
    cheek.radii_mm = {20, 10};
    cheek.change = {0.5F, 0.4F};
    pattern.regions.push_back(cheek);
    return pattern;
}

TEST(HemoglobinPattern, ThereIsOneForEveryMapOfTheRig) {
    const Rig rig(small_face());
    const auto maps = rig.hemoglobin_maps();
    EXPECT_TRUE(std::ranges::equal(hemoglobin_pattern_names, maps));
}

TEST(HemoglobinPattern, IsFullAtItsCentreOnBothSides) {
    const HemoglobinPattern pattern = cheeks();
    EXPECT_NEAR(change_at(pattern, {50, -30}).mean, 0.6F, 1e-5F);
    EXPECT_EQ(change_at(pattern, {50, -30}).mean, change_at(pattern, {-50, -30}).mean);
    EXPECT_NEAR(change_at(pattern, {70, -30}).mean, 0.1F + 0.5F * std::exp(-1.0F), 1e-5F);
    EXPECT_NEAR(change_at(pattern, {50, 60}).mean, 0.1F, 1e-5F);
    // Once around the head and back.
    EXPECT_NEAR(change_at(pattern, {50 + CanonicalFrame::turn_mm(), -30}).mean, 0.6F, 1e-3F);
}

TEST(HemoglobinPattern, FillsTheCheeksOfAFaceAndLeavesItsNeutralAlone) {
    const Face face = small_face();
    const auto skin = skin_primitives(face);
    const auto canonical = canonical_map(face, skin, CanonicalFrame(*landmarks_from_targets(face, skin)), 32, 32);
    AppearanceMaps maps;
    maps.melanin = ScalarMap(64, 64, 0.02F);
    maps.hemoglobin = ScalarMap(64, 64, 0.02F);
    maps.skin = ScalarMap(64, 64, 1);
    const HemoglobinPattern pattern = cheeks();
    HemoglobinMapOptions options;
    options.side = 32;
    const HemoglobinMaps blood = hemoglobin_maps(maps, *canonical, std::span(&pattern, 1), options);
    ASSERT_EQ(blood.names.size(), 1U);
    EXPECT_EQ(blood.names[0], "blush");
    const float weight = 1;
    const ScalarMap blushed = blended_hemoglobin(maps.hemoglobin, maps.skin, std::span(&weight, 1), blood.changes);
    float fullest = 0;
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const float h = blushed.at(x, y);
            fullest = std::max(fullest, h);
            EXPECT_GE(h, 0.0219F);
            const glm::vec2 place = canonical->canonical_mm.at(x / 2, y / 2);
            // By the bell of the region, which a coarse map blurs by a texel (7 mm here).
            EXPECT_NEAR(h, 0.02F * (1 + change_at(pattern, place).mean), 0.003F) << place.x << " " << place.y;
        }
    }
    EXPECT_GT(fullest, 0.03F);
}

}  // namespace
}  // namespace blush
