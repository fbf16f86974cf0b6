#include "rig/far_vertices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/rest_places.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

Face baked(Face face, glm::vec3 far) {
    for (glm::vec3& position : face.positions) position += far;
    for (Skin& skin : face.skins) {
        for (glm::mat4& matrix : skin.joint_from_mesh) matrix[3] -= glm::vec4(far, 0);
    }
    for (std::size_t n = 1; n + 1 < face.nodes.size(); ++n) face.nodes[n].rest.translation += far;
    return face;
}

TEST(FarVertices, NothingMovesAndNothingIsRounded) {
    for (const bool joints : {false, true}) {
        for (const float far : {0.0F, 3.0F, 30.0F, 100.0F, 1e4F, 1e6F}) {
            const Face file = baked(test::make_face({.targets = 2, .two_primitives = true, .joints = joints}),
                                    {far, -far, 0.25F * far});
            Face face = file;
            const Recentred recentred = recentre(face);
            const Status valid = validate(face);
            ASSERT_TRUE(valid) << valid.error().message;
            const glm::vec3 origin = recentred.mesh_origin[0];
            EXPECT_EQ(origin != glm::vec3(0), far > far_ratio) << far;
            for (std::size_t v = 0; v < face.positions.size(); ++v) {
                const glm::dvec3 exact = glm::dvec3(face.positions[v]) + glm::dvec3(origin);
                ASSERT_EQ(exact, glm::dvec3(file.positions[v])) << far;
            }
            EXPECT_EQ(face.nodes.size(), file.nodes.size() + (far > far_ratio ? 1U : 0U));
            const glm::dvec3 near(glm::vec3(far, -far, 0.25F * far));
            const std::vector<glm::dvec3> before = rest_places(file, near), after = rest_places(face, near);
            // Skinned before it was taken back, a vertex is off by what floats out there are apart.
            const double step = joints ? 4 * float_step(file) : 1e-9;
            for (std::size_t v = 0; v < face.positions.size(); ++v) {
                ASSERT_LE(glm::length(before[v] - after[v]), step) << far;
                if (far > far_ratio) {
                    ASSERT_LT(glm::length(glm::vec2(face.positions[v])), 3.5F);
                }
            }
        }
    }
}

TEST(FarVertices, TheStepIsThatOfTheFarthestFloat) {
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& position : face.positions) position.y += 10000;
    EXPECT_EQ(float_step(face), std::ldexp(1.0, -10)) << "8192 to 16384: 24 bits down to 1/1024";
    face.nodes[0].rest.scale = {1, 3, 1};
    EXPECT_EQ(float_step(face), 3 * std::ldexp(1.0, -10));
    face.nodes[0].mesh = -1;
    EXPECT_EQ(float_step(face), 0) << "nothing is drawn";
}

TEST(FarVertices, AnAxisAlongWhichTheFaceLiesAcrossTheOriginStays) {
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& position : face.positions) position.y += 1000;
    const Face file = face;
    const glm::vec3 origin = recentre(face).mesh_origin[0];
    EXPECT_EQ(origin.x, 0);
    EXPECT_EQ(origin.z, 0);
    EXPECT_NEAR(origin.y, 1000, 1);
    for (std::size_t v = 0; v < face.positions.size(); ++v) EXPECT_EQ(face.positions[v].x, file.positions[v].x);
}

TEST(FarVertices, AHeadOnABodyIsNotFar) {
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& position : face.positions) position = 0.12F * position + glm::vec3(0, 1.6F, 0);
    const Face file = face;
    EXPECT_EQ(recentre(face).mesh_origin[0], glm::vec3(0));
    EXPECT_EQ(face.positions, file.positions);
}

}  // namespace
}  // namespace blush
