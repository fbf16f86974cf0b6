// Points of the surface, found on the CPU, against the surface that the GPU made.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/deform/deform.h"
#include "runtime/frame/character_state.h"
#include "tests/gl/surface/surface_reading.h"
#include "tests/gl_fixture.h"
#include "tests/rig/count_allocations.h"
#include "tests/rotation.h"

namespace blush {
namespace {

class SurfacePoints : public test::GlTest {
protected:
    /// Turned, scaled and moved nodes, so that a mesh's space is not the file's.
    static Face face_of(int kind) {
        Face face = test::make_face({.targets = 8,
                                     .normal_deltas = (kind & 1) != 0,
                                     .odd_without_normals = (kind & 2) != 0,
                                     .tangent_deltas = (kind & 2) != 0,
                                     .two_primitives = (kind & 4) != 0,
                                     .seam = true,
                                     .joints = (kind & 8) != 0});
        Node& head = face.nodes[0];
        head.rest.translation = {0.3F, 12, -0.7F};
        head.rest.rotation = rotation_of(glm::angleAxis(0.4F, glm::normalize(glm::vec3(1, 2, 3))));
        if ((kind & 1) != 0) head.rest.scale = {1.5F, 0.7F, 1.1F};
        return face;
    }
    static glm::dmat4 somewhere(test::Random& random) {
        const auto one = [&random] { return static_cast<double>(random.between(-1, 1)); };
        return glm::translate(glm::dmat4(1), glm::dvec3(1000 * one(), 50 * one(), 300 * one())) *
               glm::rotate(glm::dmat4(1), 3 * one(), glm::normalize(glm::dvec3(one(), one(), 1))) *
               glm::scale(glm::dmat4(1), glm::dvec3(1.2));
    }
    static SurfacePlace any_place(test::Random& random, const Face& face) {
        glm::vec3 weights(random.between(0, 1), random.between(0, 1), random.between(0, 1));
        return {static_cast<std::uint32_t>(random.bits() % (face.indices.size() / 3)),
                weights / (weights.x + weights.y + weights.z + 1e-6F)};
    }
};

TEST_F(SurfacePoints, StandOnTheSurfaceThatTheGpuDeformsInEveryPose) {
    test::Random random(11);
    double farthest = 0, steepest = 0, tangents = 0;
    for (int kind = 0; kind < 16; ++kind) {
        const FaceAsset asset = *FaceAsset::create(face_of(kind));
        Character character = *Character::create(device_, asset);
        Scene scene = *Scene::create(device_);
        ASSERT_TRUE(scene.add(character));
        if ((kind & 4) != 0) {
            ASSERT_TRUE(character.set("normals.source", "recomputed"));
        }
        const Face& face = character.face();
        std::vector<SurfacePoint> points;
        for (int p = 0; p < 12; ++p) points.push_back(*asset.attach(any_place(random, face)));
        for (int pose = 0; pose < 24; ++pose) {
            for (float& control : character.controls()) control = pose == 0 ? 0 : random.between(-1, 1);
            for (Transform& node : character.pose().nodes) node.translation.x += random.between(-0.1F, 0.1F);
            const glm::dmat4 place = somewhere(random);
            character.place(place);
            if (!face.joints.empty() && pose % 3 == 2) {
                std::vector<glm::mat4> joints(2, glm::mat4(1));
                for (glm::mat4& joint : joints) joint = glm::rotate(joint, random.between(-1, 1), glm::vec3(0, 1, 0));
                ASSERT_TRUE(character.set_joints(joints));
            } else {
                ASSERT_TRUE(character.set_joints({}));
            }
            // Asked before anything is drawn, so that nothing comes from the GPU.
            std::vector<SurfaceFrame> frames;
            for (const SurfacePoint& point : points) frames.push_back(*character.at(point));

            Scene::Surface surface = scene.read_deformed(character);
            const CharacterState& state = character.state();
            std::size_t entry = 0;
            if (!face.joints.empty()) {
                entry = face.nodes.size();
                skin(face.joints, face.joint_weights, state.stance.skinned_from_mesh, surface.positions,
                     surface.normals, surface.tangents);
                const Scene::Surface published = test::read_published(character.surface());
                for (std::size_t v = 0; v < published.positions.size(); ++v) {
                    ASSERT_LT(glm::length(published.positions[v] - surface.positions[v]), 1e-5F);
                }
            }
            const glm::dmat4& world = state.stance.world_from_node[entry];
            const glm::dmat3 normal_from_mesh = glm::transpose(glm::inverse(glm::dmat3(world)));
            for (std::size_t p = 0; p < points.size(); ++p) {
                glm::dvec3 position(0), normal(0), tangent(0);
                for (std::size_t c = 0; c < 3; ++c) {
                    const SurfacePlace& at = points[p].place();
                    const std::uint32_t v = face.indices[3 * at.triangle + c];
                    const double weight =
                        static_cast<double>(at.barycentrics[static_cast<glm::length_t>(c)]) /
                        static_cast<double>(at.barycentrics.x + at.barycentrics.y + at.barycentrics.z);
                    position += weight * glm::dvec3(surface.positions[v]);
                    normal += weight * glm::dvec3(surface.normals[v]);
                    tangent += weight * glm::dvec3(surface.tangents[v]);
                }
                position = glm::dvec3(world * glm::dvec4(position, 1));
                normal = glm::normalize(normal_from_mesh * normal);
                const glm::dvec3 along = glm::dmat3(world) * tangent;
                tangent = glm::normalize(along - normal * glm::dot(normal, along));
                farthest = std::max(farthest, glm::length(position - frames[p].position_world));
                steepest = std::max(steepest, glm::length(normal - glm::dvec3(frames[p].normal_world)));
                tangents = std::max(tangents, glm::length(tangent - glm::dvec3(frames[p].tangent_world)));
                const glm::dmat4 matrix = frames[p].world_from_point();
                ASSERT_NEAR(glm::determinant(glm::dmat3(matrix)), static_cast<double>(frames[p].tangent_world.w), 1e-5);
            }
        }
    }
    std::cout << "farthest " << farthest << ", normals " << steepest << ", tangents " << tangents << "\n";
    EXPECT_LT(farthest, 2e-6);
    EXPECT_LT(steepest, 2e-6);
    EXPECT_LT(tangents, 2e-5);  // of the few whose texture runs nearly along the normal
}

TEST_F(SurfacePoints, CostNoMemoryOnceAsked) {
    const FaceAsset asset = *FaceAsset::create(face_of(11));
    Character character = *Character::create(device_, asset);
    test::Random random(2);
    std::vector<SurfacePoint> points;
    for (int p = 0; p < 8; ++p) points.push_back(*asset.attach(any_place(random, asset.face())));
    for (const SurfacePoint& point : points) ASSERT_TRUE(character.at(point));
    const std::size_t before = test::allocation_count();
    for (int pose = 0; pose < 20; ++pose) {
        for (float& control : character.controls()) control = random.between(-1, 1);
        character.place(somewhere(random));
        for (const SurfacePoint& point : points) (void)character.at(point);
        for (const Socket socket : {Socket::head, Socket::jaw, Socket::left_eye, Socket::right_eye})
            (void)character.socket(socket);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

TEST_F(SurfacePoints, AreFoundByPlaceAndStayWhereTheyWereFound) {
    for (const int kind : {1, 9}) {
        const FaceAsset asset = *FaceAsset::create(face_of(kind));
        Character character = *Character::create(device_, asset);
        test::Random random(9);
        for (int round = 0; round < 50; ++round) {
            const SurfacePoint point = *asset.attach(any_place(random, asset.face()));
            const glm::dvec3 place = character.at(point)->position_world;
            const std::optional<SurfacePlace> nearest = asset.nearest_place(place);
            ASSERT_TRUE(nearest);
            const SurfacePoint found = *asset.attach(*nearest);
            EXPECT_LT(glm::length(character.at(found)->position_world - place), 2e-6);
        }
        EXPECT_FALSE(asset.nearest_place(glm::dvec3(std::nan(""), 0, 0)));
        EXPECT_TRUE(asset.nearest_place(glm::dvec3(1e9, 0, 0)));
    }
}

TEST_F(SurfacePoints, ThatCannotBeAreRefusedInOneSentence) {
    const FaceAsset asset = *FaceAsset::create(face_of(0));
    const auto triangles = static_cast<std::uint32_t>(asset.face().indices.size() / 3);
    EXPECT_EQ(asset.attach({triangles, {1, 0, 0}}).error().message,
              "test_face: triangle " + std::to_string(triangles) + " of a surface point does not exist; the face has " +
                  std::to_string(triangles));
    EXPECT_FALSE(asset.attach({0xffffffff, {1, 0, 0}}));
    for (const glm::vec3 bad : {glm::vec3(NAN, 0, 1), glm::vec3(INFINITY, 0, 0), glm::vec3(1, -1, 0), glm::vec3(0)}) {
        EXPECT_EQ(asset.attach({2, bad}).error().message,
                  "test_face: triangle 2: the barycentrics of a surface point must be finite, and their sum not zero");
    }
    // Of another asset, or gone.
    const FaceAsset other = *FaceAsset::create(face_of(0));
    Character character = *Character::create(device_, asset);
    SurfacePoint point = *other.attach({2, {1, 1, 1}});
    EXPECT_FALSE(character.at(point));
    SurfacePoint own = *asset.attach({2, {1, 1, 1}});
    EXPECT_TRUE(character.at(own));
    const SurfacePoint taken = std::move(own);
    EXPECT_FALSE(character.at(own));  // NOLINT(bugprone-use-after-move)
    EXPECT_EQ(own.place().triangle, 0U);
    // The same face with other maps has the same surface.
    Character painted = *Character::create(device_, asset.with_appearance({}));
    EXPECT_TRUE(painted.at(taken));

    Face undrawn = face_of(0);
    undrawn.nodes[0].mesh = -1;
    EXPECT_EQ(FaceAsset::create(undrawn)->attach({2, {1, 1, 1}}).error().message,
              "test_face: triangle 2 of a surface point is of a mesh that no node draws");
    EXPECT_FALSE(FaceAsset::create(undrawn)->nearest_place(glm::dvec3(0)));
}

}  // namespace
}  // namespace blush
