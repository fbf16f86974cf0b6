// How large a face is, by what it tells.

#include "rig/head/face_scale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/test_faces.h"

namespace blush {
namespace {

/// Two corners as a face of one primitive.
Face of_size(glm::vec3 size) {
    Face face = test::make_face({.side = 4, .targets = 0});
    glm::vec3 low(1e9F), high(-1e9F);
    for (const glm::vec3& p : face.positions) low = glm::min(low, p), high = glm::max(high, p);
    for (glm::vec3& p : face.positions) p = (p - low) / (high - low) * size;
    return face;
}

TEST(FaceScale, MetresAreMetres) {
    const FaceScale scale = face_scale(of_size({0.17F, 0.26F, 0.2F}));
    EXPECT_EQ(scale.millimetres_a_unit, 1000);
    EXPECT_EQ(scale.told_by, "its largest extent is that of a head in metres");
}

TEST(FaceScale, AHeadIs240Millimetres) { EXPECT_NEAR(face_scale(of_size({17, 24, 20})).millimetres_a_unit, 10, 1e-5); }

TEST(FaceScale, ABustHasShoulders) {
    const FaceScale scale = face_scale(of_size({8.55F, 7.94F, 5.18F}));  // the bounds of a scanned bust
    EXPECT_NEAR(scale.millimetres_a_unit, 52.6, 0.1);
    EXPECT_EQ(scale.told_by,
              "it is as wide as tall: a bust, whose shoulders are "
              "taken as 450 mm wide");
}

TEST(FaceScale, NothingIsStillFinite) {
    EXPECT_GT(face_scale(Face{}).millimetres_a_unit, 0);
    for (const float s : {0.0F, 1e-30F, 1e30F}) {
        const double scale = face_scale(of_size(glm::vec3(s))).millimetres_a_unit;
        EXPECT_TRUE(std::isfinite(scale) && scale > 0) << s;
    }
}

}  // namespace
}  // namespace blush
