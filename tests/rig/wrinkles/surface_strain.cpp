// Strain of the surface, against deformations whose stretch is known.

#include "rig/wrinkles/surface_strain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "rig/deform/rest_frame.h"

namespace blush {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

const Triangle triangle = {{{0.3, 0.1, 0.2}, {1.4, 0.2, 0.1}, {0.2, 0.9, 0.5}}};

Triangle transformed(const glm::dmat3& by) { return {by * triangle[0], by * triangle[1], by * triangle[2]}; }

glm::dmat3 turned(double angle) {
    return {{std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}};
}

TEST(SurfaceStrain, RestAndRigidMotionStretchNothing) {
    for (const glm::dmat3& by : {glm::dmat3(1), turned(0.7), turned(-2)}) {
        Triangle moved = transformed(by);
        for (glm::dvec3& corner : moved) corner += glm::dvec3(5, -3, 2);
        const Stretch stretch = stretch_of(triangle, moved);
        EXPECT_NEAR(stretch.least, 1, 1e-12);
        EXPECT_NEAR(stretch.most, 1, 1e-12);
    }
}

TEST(SurfaceStrain, UniformScaleIsItsFactor) {
    const Stretch stretch = stretch_of(triangle, transformed(glm::dmat3(0.7)));
    EXPECT_NEAR(stretch.least, 0.7, 1e-12);
    EXPECT_NEAR(stretch.most, 0.7, 1e-12);
}

TEST(SurfaceStrain, SqueezeOfAPlaneIsFoundWithItsDirection) {
    for (int degrees = 0; degrees < 180; degrees += 15) {
        const double angle = degrees * 3.14159265358979 / 180;
        const glm::dvec3 axis(std::cos(angle), std::sin(angle), 0);
        const Triangle flat = {{{0, 0, 0}, {1, 0.2, 0}, {0.1, 0.8, 0}}};
        Triangle squeezed = flat;
        for (glm::dvec3& corner : squeezed) corner -= 0.4 * glm::dot(corner, axis) * axis;
        const Stretch stretch = stretch_of(flat, squeezed);
        EXPECT_NEAR(stretch.least, 0.6, 1e-12);
        EXPECT_NEAR(stretch.most, 1, 1e-12);
        EXPECT_NEAR(std::abs(glm::dot(stretch.direction_of_least, axis)), 1, 1e-9);
    }
}

TEST(SurfaceStrain, ATriangleWithoutAreaIsUnchanged) {
    const Triangle line = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
    EXPECT_EQ(stretch_of(line, triangle).least, 1);
    const Triangle point{};
    EXPECT_EQ(stretch_of(point, triangle).most, 1);
}

TEST(SurfaceStrain, VerticesAtOnePlaceShareTheirCompression) {
    Face face;  // two triangles that meet along a seam of doubled vertices
    face.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    face.indices = {0, 1, 2, 3, 4, 5};
    std::vector<glm::vec3> deformed = face.positions;
    for (glm::vec3& p : deformed) p.x *= 0.5F;
    const std::vector<Compression> compression = vertex_compression(face, weld(face.positions), deformed);
    for (const Compression& tensor : compression) {
        const PrincipalCompression principal = principal_compression(tensor, {0, 0, 1});
        EXPECT_NEAR(principal.amount, 0.5, 1e-6);
        EXPECT_NEAR(std::abs(principal.direction.x), 1, 1e-6);
    }
    deformed = face.positions;
    deformed[0].x = 0.5F;  // squeezes the first triangle only; the seam's vertices see half of it
    const std::vector<Compression> half = vertex_compression(face, weld(face.positions), deformed);
    EXPECT_EQ(half[1], half[3]);
    EXPECT_EQ(half[2], half[5]);
    EXPECT_EQ(principal_compression(half[4], {0, 0, 1}).amount, 0);
}

}  // namespace
}  // namespace blush
