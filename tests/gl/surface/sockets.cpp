// Sockets of head, jaw and eyes: they go as their sources go.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/gl/surface/surface_reading.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"

namespace blush {
namespace {

double farthest(const glm::dmat4& a, const glm::dmat4& b) {
    double worst = 0;
    for (glm::length_t c = 0; c < 4; ++c) {
        for (glm::length_t r = 0; r < 4; ++r) worst = std::max(worst, std::abs(a[c][r] - b[c][r]));
    }
    return worst;
}

/// A ball of a material named eye, in the mesh of a node of its own.
void add_ball(Face& face, const std::string& node_name, glm::vec3 centre, float radius) {
    const auto first_vertex = static_cast<std::uint32_t>(face.positions.size());
    const auto first_index = static_cast<std::uint32_t>(face.indices.size());
    constexpr std::uint32_t columns = 12, rows = 7;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const float a = 6.2831853F * static_cast<float>(column) / columns;
            const float b = 3.1415927F * static_cast<float>(row) / (rows - 1);
            const glm::vec3 n(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
            face.positions.push_back(centre + radius * n);
            face.normals.push_back(n);
            face.tangents.emplace_back(
                std::abs(n.x) < 0.9F ? glm::normalize(glm::cross(n, glm::vec3(1, 0, 0))) : glm::vec3(0, 0, 1), 1);
            face.uv0.emplace_back(0);
            face.uv1.emplace_back(0);
        }
    }
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t next = (column + 1) % columns;
            const std::uint32_t a = first_vertex + row * columns + column, b = first_vertex + row * columns + next;
            face.indices.insert(face.indices.end(), {a, b, a + columns, b, b + columns, a + columns});
        }
    }
    if (face.materials.size() < 2) {
        Material eye;
        eye.name = "eyeball";
        face.materials.push_back(eye);
    }
    Primitive primitive;
    primitive.mesh = static_cast<std::uint32_t>(face.meshes.size());
    primitive.first_vertex = first_vertex;
    primitive.vertex_count = static_cast<std::uint32_t>(face.positions.size()) - first_vertex;
    primitive.first_index = first_index;
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size()) - first_index;
    primitive.material = 1;
    face.meshes.push_back({"ball", static_cast<std::uint32_t>(face.primitives.size()), 1});
    face.primitives.push_back(primitive);
    Node node;
    node.name = node_name;
    node.parent = 0;
    node.mesh = static_cast<std::int32_t>(face.meshes.size()) - 1;
    face.nodes.push_back(node);
}

/// Turns the vertices of one primitive about a point, as far as a target of weight 1 can.
void add_turn(Face& face, const std::string& name, std::size_t primitive, glm::vec3 about, glm::mat3 turn) {
    Target target;
    target.name = name;
    const Primitive& part = face.primitives[primitive];
    for (std::uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
        target.vertices.push_back(v);
        target.position_deltas.push_back(turn * (face.positions[v] - about) + about - face.positions[v]);
    }
    face.targets.push_back(target);
    test::find_normal_sources(face);
}

class Sockets : public test::GlTest {
protected:
    Character character_of(Face face) const { return *Character::create(device_, *FaceAsset::create(std::move(face))); }
    static glm::dmat4 place() {
        return glm::translate(glm::dmat4(1), glm::dvec3(1e6, 20, -5)) *
               glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(0, 1, 0)) * glm::scale(glm::dmat4(1), glm::dvec3(2));
    }
};

TEST_F(Sockets, TheHeadsTurnsWithItsNodeAndStandsWhereItTurns) {
    Face face = test::make_face({.targets = 1});
    face.nodes[0].rest.scale = glm::vec3(0.5F);
    face.nodes[0].rest.translation = {3, 1, 2};
    Character character = character_of(face);
    character.place(place());
    const glm::dmat4 rest = *character.socket(Socket::head);
    EXPECT_LT(farthest(glm::dmat4(glm::dmat3(rest)), glm::dmat4(glm::dmat3(place()))), 1e-12) << "the file's own axes";
    character.set(*character.control("headYaw"), 0.5F);
    const glm::dmat4 turned = *character.socket(Socket::head);
    EXPECT_LT(glm::length(turned[3] - rest[3]), 1e-6) << "it turns about its origin";
    EXPECT_LT(farthest(glm::inverse(rest) * turned,
                       glm::rotate(glm::dmat4(1), static_cast<double>(0.5F), glm::dvec3(0, 1, 0))),
              1e-6);
    // Whatever hangs there stays beside the same vertex of the surface.
    const SurfacePoint point = *character.asset().attach({40, {1, 1, 1}});
    const glm::dvec4 there(character.at(point)->position_world, 1);
    character.set(*character.control("headYaw"), 0);
    const glm::dvec4 before(character.at(point)->position_world, 1);
    EXPECT_LT(glm::length(glm::inverse(turned) * there - glm::inverse(rest) * before), 1e-8);
}

TEST_F(Sockets, TheEyesComeFromNodesElseFromTheSurfaceOfTheBalls) {
    const glm::vec3 left(0.4F, 0.2F, 0.5F), right(-0.4F, 0.2F, 0.5F);
    for (const bool nodes : {false, true}) {
        Face face = test::make_face({.targets = 0});
        face.materials[0].name = "skin";
        add_ball(face, nodes ? "eyeLeft" : "ball a", left, 0.15F);
        add_ball(face, nodes ? "eyeRight" : "ball b", right, 0.15F);
        const glm::mat3 turn(glm::rotate(glm::mat4(1), 0.3F, glm::vec3(0, 1, 0)));
        add_turn(face, "lookAside", 1, left, turn);
        Character character = character_of(face);
        character.place(place());
        const glm::dmat4 rest = *character.socket(Socket::left_eye), other = *character.socket(Socket::right_eye);
        EXPECT_LT(glm::length(glm::inverse(place()) * rest[3] - glm::dvec4(left, 1)), nodes ? 1e-6 : 0.02);
        EXPECT_LT(glm::length(glm::inverse(place()) * other[3] - glm::dvec4(right, 1)), nodes ? 1e-6 : 0.02);
        if (nodes) {
            character.set(*character.control("leftEyeYaw"), 0.3F);
        } else {
            character.set(*character.control("lookAside"), 1);
        }
        const glm::dmat4 turned = *character.socket(Socket::left_eye);
        EXPECT_LT(farthest(glm::dmat4(glm::dmat3(glm::inverse(rest) * turned)), glm::dmat4(glm::dmat3(turn))), 2e-6);
        EXPECT_LT(farthest(*character.socket(Socket::right_eye), other), 1e-9) << "the other one rests";
    }
}

TEST_F(Sockets, TheJawIsFittedToTheChin) {
    Face face = test::make_face({.targets = 0});
    face.materials[0].name = "skin";
    // The lower part turns about a hinge far back, fading out above the mouth; a smile moves what is beside it.
    const glm::vec3 hinge(0, 0.2F, -0.8F);
    const double angle = 0.25;
    const glm::mat3 turn(glm::rotate(glm::mat4(1), static_cast<float>(angle), glm::vec3(1, 0, 0)));
    Target open;
    open.name = "jaw_open";
    for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
        const float share = glm::smoothstep(0.1F, -0.3F, face.positions[v].y);
        if (share == 0) continue;
        open.vertices.push_back(v);
        open.position_deltas.push_back(share * (turn * (face.positions[v] - hinge) + hinge - face.positions[v]));
    }
    face.targets.push_back(open);
    test::find_normal_sources(face);
    Character character = character_of(face);
    character.place(place());
    const glm::dmat4 rest = *character.socket(Socket::jaw);
    EXPECT_LT(farthest(glm::dmat4(glm::dmat3(rest)), glm::dmat4(glm::dmat3(place()))), 1e-12);
    character.set(*character.control("jawOpen"), 1);
    const glm::dmat4 opened = *character.socket(Socket::jaw);
    const glm::dmat4 motion = glm::inverse(place()) * opened * glm::inverse(rest) * place();
    const glm::dmat4 exact = glm::translate(glm::dmat4(1), glm::dvec3(hinge)) *
                             glm::rotate(glm::dmat4(1), angle, glm::dvec3(1, 0, 0)) *
                             glm::translate(glm::dmat4(1), -glm::dvec3(hinge));
    std::cout << "jaw fitted within " << farthest(motion, exact) << "\n";
    EXPECT_LT(farthest(motion, exact), 2e-3) << "a few of the vertices go not quite the bone's whole way";
    character.set(*character.control("jawOpen"), 0);
    EXPECT_EQ(farthest(*character.socket(Socket::jaw), rest), 0);
}

TEST_F(Sockets, JointsCarryWhatIsNamedAfterThem) {
    Face face = test::make_face({.targets = 1, .joints = true});
    face.nodes[1].name = "mixamorig:Head";
    face.nodes[2].name = "Jaw";
    Character character = character_of(face);
    character.place(place());
    const glm::dmat4 rest = *character.socket(Socket::jaw);
    const glm::dvec4 joint_at(glm::dvec3(face.nodes[0].rest.translation + face.nodes[2].rest.translation), 1);
    EXPECT_LT(glm::length(rest[3] - place() * joint_at), 1e-6);
    const glm::quat turn = glm::angleAxis(0.4F, glm::vec3(1, 0, 0));
    character.pose().nodes[2].rotation = rotation_of(turn);
    const glm::dmat4 by_node = *character.socket(Socket::jaw);
    EXPECT_LT(farthest(glm::dmat4(glm::dmat3(glm::inverse(rest) * by_node)), glm::mat4_cast(glm::dquat(turn))), 1e-6);
    // The same from the host's skeleton.
    character.pose().nodes[2].rotation = {};
    std::vector<glm::mat4> joints = {glm::mat4(1), glm::mat4(1)};
    const glm::mat4 at = glm::translate(glm::mat4(1), glm::vec3(joint_at));
    joints[1] = at * glm::mat4_cast(turn) * glm::inverse(at);
    ASSERT_TRUE(character.set_joints(joints));
    EXPECT_LT(farthest(*character.socket(Socket::jaw), by_node), 1e-5);
    ASSERT_TRUE(character.socket(Socket::head));
}

TEST_F(Sockets, WhatAFaceDoesNotHaveIsNotThere) {
    const Character character = character_of(test::make_face({.targets = 2}));
    EXPECT_TRUE(character.socket(Socket::head));
    EXPECT_FALSE(character.socket(Socket::jaw));
    EXPECT_FALSE(character.socket(Socket::left_eye));
    EXPECT_FALSE(character.socket(Socket::right_eye));
    EXPECT_FALSE(character.socket(static_cast<Socket>(17)));
    Face flat = test::make_face({.targets = 0});
    flat.nodes[0].rest.scale = glm::vec3(0);
    EXPECT_FALSE(character_of(flat).socket(Socket::head)) << "a node of no size has no axes";
}

TEST_F(Sockets, TheDefaultFaceHasThemAll) {
    const Result<FaceAsset> asset = FaceAsset::load(std::string(BLUSH_BINARY_DIR) + "/assets/face.glb");
    ASSERT_TRUE(asset) << asset.error().message;
    Character character = *Character::create(device_, *asset);
    for (const Socket socket : {Socket::head, Socket::jaw, Socket::left_eye, Socket::right_eye})
        ASSERT_TRUE(character.socket(socket)) << static_cast<int>(socket);
    const glm::dvec4 chin = (*character.socket(Socket::jaw))[3], left = (*character.socket(Socket::left_eye))[3];
    EXPECT_GT(left.y - chin.y, 0.05) << "metres: the chin is below the eyes";
    EXPECT_GT(left.x, 0.02);
    character.set(*character.control("jawOpen"), 1);
    const glm::dmat4 open = *character.socket(Socket::jaw);
    EXPECT_LT(open[3].y, chin.y - 0.005);
    const double degrees = glm::degrees(std::atan2(-open[2].y, open[2].z));
    std::cout << "jawOpen turns the jaw by " << degrees << " degrees, and lowers the chin by "
              << 1000 * (chin.y - open[3].y) << " mm\n";
    EXPECT_GT(degrees, 3);
    EXPECT_LT(degrees, 40);
}

}  // namespace
}  // namespace blush
