#include "rig/deform/rest_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush {
namespace {

constexpr float tolerance = 1e-6F;

void expect_unit(glm::vec3 v) { EXPECT_NEAR(glm::length(v), 1, tolerance) << v.x << " " << v.y << " " << v.z; }

TEST(RestFrame, PerpendicularIsPerpendicular) {
    for (const glm::vec3 v : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1),
                              glm::vec3(0.6F, 0, 0.8F), glm::normalize(glm::vec3(1, 1, 1))}) {
        expect_unit(any_perpendicular(v));
        EXPECT_NEAR(glm::dot(v, any_perpendicular(v)), 0, tolerance);
    }
    expect_unit(any_perpendicular(glm::vec3(0)));
    expect_unit(any_perpendicular(glm::vec3(std::numeric_limits<float>::quiet_NaN())));
}

TEST(RestFrame, NormalsAreWeightedByAngleAndWelded) {
    // A triangle of area 2 in z = 0 and one of area 0.5 in x = 0 share the edge from (0,0,0) to (0,1,0)... once by
    // index, once by position alone: the results are the same.
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {4, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const auto normals = smooth_normals(positions, std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
    // Both have a right angle at (0,0,0); at (0,1,0) the angles are atan(4) and 45 degrees.
    const glm::vec3 at_origin = glm::normalize(glm::vec3(1, 0, 1));
    const glm::vec3 at_top = glm::normalize(glm::vec3(std::atan(1.0F), 0, std::atan(4.0F)));
    for (const std::size_t i : {0U, 3U}) EXPECT_LT(glm::distance(normals[i], at_origin), tolerance) << i;
    for (const std::size_t i : {2U, 4U}) EXPECT_LT(glm::distance(normals[i], at_top), tolerance) << i;
    EXPECT_EQ(normals[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(normals[5], glm::vec3(1, 0, 0));
}

TEST(RestFrame, ZeroAreaTriangleGivesUnitNormals) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
    for (const glm::vec3& n : smooth_normals(positions, std::vector<std::uint32_t>{0, 1, 2, 0, 0, 0}))
        EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST(RestFrame, HugeAndTinyTrianglesGiveUnitNormals) {
    for (const float size : {1e-30F, 1e30F, std::numeric_limits<float>::max()}) {
        const std::vector<glm::vec3> positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        for (const glm::vec3& n : smooth_normals(positions, std::vector<std::uint32_t>{0, 1, 2}))
            EXPECT_EQ(n, glm::vec3(0, 0, 1)) << size;
    }
}

TEST(RestFrame, OppositeTrianglesGiveUnitNormals) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const glm::vec3& n : smooth_normals(positions, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1})) expect_unit(n);
}

class Tangents : public testing::Test {
protected:
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<glm::vec3> normals = std::vector<glm::vec3>(3, {0, 0, 1});
    const std::vector<std::uint32_t> triangle = {0, 1, 2};
};

// An image's v grows downwards, so a texture that reads rightly from outside has v against y here.

TEST_F(Tangents, FollowUAndPointUpInTheImage) {
    for (const glm::vec4& t :
         tangents_from_uv(positions, normals, std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}}, triangle)) {
        EXPECT_EQ(t, glm::vec4(1, 0, 0, 1));
    }
    for (const glm::vec4& t :
         tangents_from_uv(positions, normals, std::vector<glm::vec2>{{0, 0}, {0, 1}, {1, 0}}, triangle)) {
        EXPECT_EQ(t, glm::vec4(0, 1, 0, 1));
    }
}

TEST_F(Tangents, MirroredTextureTurnsTheSign) {
    for (const glm::vec4& t :
         tangents_from_uv(positions, normals, std::vector<glm::vec2>{{1, 1}, {0, 1}, {1, 0}}, triangle)) {
        EXPECT_EQ(t, glm::vec4(-1, 0, 0, -1));
    }
}

TEST_F(Tangents, ZeroTextureGradientGivesAPerpendicular) {
    for (const std::vector<glm::vec2>& uv :
         {std::vector<glm::vec2>(3, {0.5F, 0.5F}), std::vector<glm::vec2>{{0, 0}, {1, 1}, {2, 2}}}) {
        for (const glm::vec4& t : tangents_from_uv(positions, normals, uv, triangle)) {
            expect_unit(glm::vec3(t));
            EXPECT_EQ(t.z, 0);
            EXPECT_EQ(t.w, 1);
        }
    }
}

TEST_F(Tangents, GradientAlongTheNormalGivesAPerpendicular) {
    const std::vector<glm::vec3> sideways(3, {1, 0, 0});
    for (const glm::vec4& t :
         tangents_from_uv(positions, sideways, std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, triangle)) {
        expect_unit(glm::vec3(t));
        EXPECT_NEAR(t.x, 0, tolerance);
    }
}

TEST_F(Tangents, MirroredHalvesThatMeetGiveUnitTangents) {
    // Left half and right half of a head share one texture: the directions cancel on the seam.
    const std::vector<glm::vec3> quad = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    const auto tangents = tangents_from_uv(quad, std::vector<glm::vec3>(4, {0, 0, 1}),
                                           std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}, {1, 0}},
                                           std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
    for (const glm::vec4& t : tangents) {
        expect_unit(glm::vec3(t));
        EXPECT_EQ(std::abs(t.w), 1);
    }
    EXPECT_EQ(tangents[1], glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(tangents[3], glm::vec4(-1, 0, 0, 1));
}

}  // namespace
}  // namespace blush
