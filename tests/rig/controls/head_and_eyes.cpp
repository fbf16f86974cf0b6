// Finding the head and the eyes by name, and where every node stands.

#include "rig/controls/head_and_eyes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/rotation.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

/// A head with two eyes that are meshes of their own, at +-0.3 along x.
Face face_with_eyes(const std::string& name_at_plus_x, const std::string& name_at_minus_x) {
    Face face = test::make_face({.targets = 0});
    face.nodes.clear();
    Node root;
    root.name = "root";
    face.nodes.push_back(root);
    Node head;
    head.name = "skin";
    head.parent = 0;
    head.mesh = 0;
    face.nodes.push_back(head);
    for (const float x : {0.3F, -0.3F}) {
        const auto first = static_cast<std::uint32_t>(face.positions.size());
        for (int corner = 0; corner < 8; ++corner) {
            face.positions.push_back(
                0.1F * glm::vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1));
        }
        face.normals.resize(face.positions.size(), {0, 0, 1});
        face.tangents.resize(face.positions.size(), {1, 0, 0, 1});
        face.uv0.resize(face.positions.size());
        face.uv1.resize(face.positions.size());
        const auto first_index = static_cast<std::uint32_t>(face.indices.size());
        for (const std::uint32_t i : {0U, 1U, 2U, 4U, 5U, 6U}) face.indices.push_back(first + i);
        test::add_primitive(face, first, first_index);
        face.primitives.back().mesh = static_cast<std::uint32_t>(face.meshes.size());
        face.meshes.push_back({"eye", static_cast<std::uint32_t>(face.primitives.size() - 1), 1});
        Node eye;
        eye.name = x > 0 ? name_at_plus_x : name_at_minus_x;
        eye.parent = 0;
        eye.mesh = static_cast<std::int32_t>(face.meshes.size() - 1);
        eye.rest.translation = {x, 0.2F, 0.6F};
        face.nodes.push_back(eye);
    }
    EXPECT_TRUE(validate(face));
    return face;
}

std::vector<glm::mat4> world_of(const Face& face, const HeadAndEyes& pivots, const Angles& head = {},
                                const Angles& left_eye = {}, const Angles& right_eye = {}) {
    Pose pose;
    for (const Node& node : face.nodes) pose.nodes.push_back(node.rest);
    pose.head = head;
    pose.left_eye = left_eye;
    pose.right_eye = right_eye;
    std::vector<glm::dmat4> placed(face.nodes.size());
    place_nodes(face, pose, pivots, placed);
    return {placed.begin(), placed.end()};
}

glm::vec3 at(const glm::mat4& world_from_node, glm::vec3 point = glm::vec3(0)) {
    return glm::vec3(world_from_node * glm::vec4(point, 1));
}

TEST(HeadAndEyes, AreFoundInEverySpelling) {
    constexpr std::pair<const char*, const char*> spellings[] = {
        {"eyeLeft", "eyeRight"},         {"Eye_L", "Eye_R"},        {"EYE_LEFT", "EYE_RIGHT"},
        {"grp_eyeLeft", "grp_eyeRight"}, {"eye.left", "eye.right"}, {"head-eye-left", "head-eye-right"},
    };
    for (const auto& [left, right] : spellings) {
        const Face face = face_with_eyes(left, right);
        const HeadAndEyes found = find_head_and_eyes(face);
        EXPECT_EQ(found.head.node, 0) << left;
        EXPECT_EQ(found.left_eye.node, 2) << left;
        EXPECT_EQ(found.right_eye.node, 3) << right;
        EXPECT_EQ(found.left_eye.point_node, glm::vec3(0)) << left;
    }
}

TEST(HeadAndEyes, TheLeftEyeIsTheOneAtTheFacesOwnLeft) {
    const Face face = face_with_eyes("eyeRight", "eyeLeft");  // named as the viewer sees them
    const HeadAndEyes found = find_head_and_eyes(face);
    EXPECT_EQ(found.left_eye.node, 2);
    EXPECT_EQ(found.right_eye.node, 3);
}

TEST(HeadAndEyes, AFaceWithoutEyeNodesHasNone) {
    const Face face = face_with_eyes("ball", "eyelid_left_upper");
    const HeadAndEyes found = find_head_and_eyes(face);
    EXPECT_EQ(found.left_eye.node, -1);
    EXPECT_EQ(found.right_eye.node, -1);
    Face no_nodes = face;
    no_nodes.nodes.clear();
    EXPECT_EQ(find_head_and_eyes(no_nodes).head.node, -1);
    EXPECT_TRUE(moving_bounds(no_nodes).empty());
}

TEST(HeadAndEyes, AnEyeWhoseOriginLiesOutsideTurnsAboutItsCentre) {
    Face face = face_with_eyes("eyeLeft", "eyeRight");
    for (std::uint32_t v = 0; v < 8; ++v) {  // the eye's vertices in the head's place, its node at the origin
        face.positions[face.primitives[1].first_vertex + v] += glm::vec3(0.3F, 0.2F, 0.6F);
    }
    face.nodes[2].rest.translation = glm::vec3(0);
    const HeadAndEyes found = find_head_and_eyes(face);
    EXPECT_LE(glm::distance(found.left_eye.point_node, glm::vec3(0.3F, 0.2F, 0.6F)), 1e-6F);
}

TEST(WorldFromNodes, ZeroAnglesGiveTheNodesOwnPlacesBitForBit) {
    const Face face = face_with_eyes("eyeLeft", "eyeRight");
    const auto with_pivots = world_of(face, find_head_and_eyes(face));
    const auto without = world_of(face, {});
    for (std::size_t n = 0; n < face.nodes.size(); ++n) EXPECT_EQ(with_pivots[n], without[n]);
    EXPECT_EQ(at(without[2]), glm::vec3(0.3F, 0.2F, 0.6F));
}

TEST(WorldFromNodes, AnEyeTurnsInPlace) {
    const Face face = face_with_eyes("eyeLeft", "eyeRight");
    const HeadAndEyes found = find_head_and_eyes(face);
    const auto rest = world_of(face, found);
    const auto world = world_of(face, found, {}, {.yaw_radians = 0.5F, .pitch_radians = 0.25F, .roll_radians = 0.1F});
    EXPECT_LE(glm::distance(at(world[2]), at(rest[2])), 1e-6F);
    EXPECT_EQ(world[3], rest[3]);
    EXPECT_EQ(world[1], rest[1]);
    const glm::vec3 point(0.1F, -0.05F, 0.1F);
    EXPECT_GT(glm::distance(at(world[2], point), at(rest[2], point)), 0.02F);
    EXPECT_NEAR(glm::distance(at(world[2], point), at(world[2])), glm::length(point), 1e-6F);
}

TEST(WorldFromNodes, AnglesTurnTheWayTheirNamesSay) {
    const Face face = face_with_eyes("eyeLeft", "eyeRight");
    const HeadAndEyes found = find_head_and_eyes(face);
    const glm::vec3 gaze(0, 0, 1);
    const auto gaze_with = [&](const Angles& angles) { return glm::mat3(world_of(face, found, {}, angles)[2]) * gaze; };
    EXPECT_GT(gaze_with({.yaw_radians = 0.3F}).x, 0.29F);     // to the face's own left
    EXPECT_LT(gaze_with({.pitch_radians = 0.3F}).y, -0.29F);  // down
    const glm::mat3 rolled(world_of(face, found, {}, {.roll_radians = 0.3F})[2]);
    EXPECT_LT((rolled * glm::vec3(0, 1, 0)).x, -0.29F);  // the top to the face's own right
}

TEST(WorldFromNodes, TheHeadCarriesEverythingRigidly) {
    const Face face = face_with_eyes("eyeLeft", "eyeRight");
    const HeadAndEyes found = find_head_and_eyes(face);
    const auto rest = world_of(face, found);
    const auto world = world_of(face, found, {.yaw_radians = 0.7F, .pitch_radians = -0.2F, .roll_radians = 0.3F});
    for (std::size_t a = 1; a < face.nodes.size(); ++a) {
        EXPECT_GT(glm::distance(at(world[a]), at(rest[a])), 0.01F);
        for (std::size_t b = 1; b < a; ++b) {
            EXPECT_NEAR(glm::distance(at(world[a]), at(world[b])), glm::distance(at(rest[a]), at(rest[b])), 1e-6F);
        }
    }
    // The pivot: in the middle from side to side, a third of the way up.
    const Bounds bounds = moving_bounds(face);
    const glm::vec3 pivot = found.head.point_node;
    EXPECT_NEAR(pivot.x, bounds.centre().x, 1e-6F);
    EXPECT_NEAR(pivot.y, bounds.low.y + bounds.size().y / 3, 1e-6F);
    EXPECT_LE(glm::distance(at(world[0], pivot), pivot), 1e-6F);
}

TEST(WorldFromNodes, ParentsComeFirstAndMatricesReplaceTransforms) {
    Face face = test::make_face({.targets = 0});
    face.nodes.clear();
    for (int n = 0; n < 3; ++n) {
        Node node;
        node.parent = n - 1;
        node.rest.translation = {1, 0, 0};
        node.rest.scale = glm::vec3(2);
        node.rest.rotation = rotation_of(glm::angleAxis(glm::radians(90.0F), glm::vec3(0, 0, 1)));
        face.nodes.push_back(node);
    }
    face.nodes[2].matrix = glm::translate(glm::mat4(1), glm::vec3(0, 0, 5));
    const auto world = world_of(face, {});
    // T * R * S: each level moves 1 along its parent's x, turned a quarter and doubled.
    EXPECT_LE(glm::distance(at(world[0], {1, 0, 0}), glm::vec3(1, 2, 0)), 1e-5F);
    EXPECT_LE(glm::distance(at(world[1]), glm::vec3(1, 2, 0)), 1e-5F);
    EXPECT_LE(glm::distance(at(world[1], {1, 0, 0}), glm::vec3(-3, 2, 0)), 1e-5F);
    EXPECT_LE(glm::distance(at(world[2]), glm::vec3(1, 2, 20)), 1e-5F);
}

TEST(SkinnedFromMeshes, PutsSkinsOneAfterTheOther) {
    Face face = test::make_face({.targets = 0, .joints = true});
    face.skins.push_back(face.skins[0]);
    std::swap(face.skins[1].joints[0], face.skins[1].joints[1]);
    const auto world = world_of(face, {});
    std::vector<glm::mat4> joints(4);
    skinned_from_meshes(face, rest_placement(face), glm::dvec3(0), joints);
    EXPECT_EQ(joints[0], world[1] * face.skins[0].joint_from_mesh[0]);
    EXPECT_EQ(joints[1], world[2] * face.skins[0].joint_from_mesh[1]);
    EXPECT_EQ(joints[2], world[2] * face.skins[1].joint_from_mesh[0]);
    EXPECT_EQ(joints[3], world[1] * face.skins[1].joint_from_mesh[1]);
}

}  // namespace
}  // namespace blush
