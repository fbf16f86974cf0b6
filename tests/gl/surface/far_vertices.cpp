// Files that bake their vertices far out are drawn as finely as their own floats allow.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/far_vertices.h"
#include "runtime/frame/character_state.h"
#include "tests/gl/surface/surface_reading.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

class FarVertices : public test::GlTest {
protected:
    static glm::vec3 out(float far) { return {far, -far, 0.5F * far}; }

    /// The same face with its vertices (and what its joints know of them) far out.
    static Face baked(Face face, glm::vec3 far) {
        for (glm::vec3& position : face.positions) position += far;
        for (Skin& skin : face.skins) {
            for (glm::mat4& matrix : skin.joint_from_mesh) matrix[3] -= glm::vec4(far, 0);
        }
        for (std::size_t n = 1; n + 1 < face.nodes.size(); ++n) face.nodes[n].rest.translation += far;
        return face;
    }
    /// At the origin, with the places that floats far out can say.
    static Face rounded(Face face, glm::vec3 far) {
        for (glm::vec3& position : face.positions) {
            position += far;
            position -= far;  // exact: neighbours out there are farther apart than here
        }
        return face;
    }
    static Face face(bool joints) {
        return test::make_face({.side = 24, .targets = 5, .normal_deltas = true, .seam = true, .joints = joints});
    }
    static Lighting lamp(glm::dvec3 place) {
        LightSource light;
        light.kind = LightKind::point;
        light.position_world = glm::dvec3(1.5, 1, 4) + place;
        light.reference_distance = 4;
        light.size = 0.05F;
        Lighting lighting;
        lighting.lights = {light};
        lighting.sky_radiance_linear = lighting.ground_radiance_linear = glm::vec3(0.1F);
        return lighting;
    }
    /// Framed as `framing` is, `place` away.
    Image picture(const FaceAsset& asset, const FaceAsset& framing, glm::dvec3 place) const {
        Character character = *Character::create(device_, asset);
        // Scale is told by bounds, which floats far out round: the same skin for all.
        EXPECT_TRUE(character.set("scattering.millimetres_a_unit", "100"));
        Scene scene = *Scene::create(device_);
        EXPECT_TRUE(scene.add(character));
        scene.set_lighting(lamp(place));
        View view = *View::create(device_);
        const Offscreen offscreen = *Offscreen::create(device_, side, side, Output::display_srgb);
        ViewFrame frame = offscreen.view();
        OrbitCamera orbit = framing.framing(1);
        orbit.target_world += place;
        orbit.yaw_radians = 0.3F;
        frame.camera = orbit.camera(1);
        frame.check_finite = true;
        for (float& control : character.controls()) control = 0.4F;
        const FrameReport& report = scene.draw(view, frame);
        EXPECT_FALSE(report.not_finite);
        return offscreen.read();
    }
};

struct Difference {
    int worst = 0;
    double mean = 0;
};
Difference difference(const Image& a, const Image& b) {
    Difference found;
    for (std::size_t i = 0; i < a.bytes.size(); ++i) {
        const int apart = std::abs(int{a.bytes[i]} - int{b.bytes[i]});
        found.worst = std::max(found.worst, apart);
        found.mean += apart;
    }
    found.mean /= static_cast<double>(a.bytes.size());
    return found;
}

TEST_F(FarVertices, AreDrawnAsFinelyAsTheFilesOwnFloats) {
    for (const bool joints : {false, true}) {
        const FaceAsset near = *FaceAsset::create(face(joints));
        const Image at_origin = picture(near, near, glm::dvec3(0));
        ASSERT_GT(test::colour_count(at_origin), test::fewest_colours);
        for (const float far : {0.0F, 3.0F, 100.0F, 1e4F, 1e6F}) {
            const FaceAsset there = *FaceAsset::create(baked(face(joints), out(far)));
            const Image drawn = picture(there, near, glm::dvec3(out(far)));
            // The file's floats and nothing else: the face that has just these places, drawn at the origin.
            const FaceAsset explained = *FaceAsset::create(rounded(face(joints), out(far)));
            const Image allowed = picture(explained, near, glm::dvec3(0));
            const Difference of_ours = difference(drawn, allowed), of_file = difference(allowed, at_origin);
            std::cout << far << (joints ? " with joints" : "") << ": from the rounded face " << of_ours.worst
                      << " (mean " << of_ours.mean << "), of that from the face " << of_file.worst << " (mean "
                      << of_file.mean << ")\n";
            EXPECT_LE(of_ours.worst, 2) << far;
            EXPECT_LE(difference(drawn, at_origin).mean, of_file.mean + 0.02) << far;
        }
    }
}

TEST_F(FarVertices, TheStatedStepIsThatOfTheFile) {
    for (const float far : {0.0F, 3.0F, 100.0F, 1e4F, 1e6F}) {
        const Face file = baked(face(false), out(far));
        const FaceAsset asset = *FaceAsset::create(file);
        double step = 0;
        for (const glm::vec3 position : file.positions) {
            for (glm::length_t c = 0; c < 3; ++c) {
                const float size = std::abs(position[c]);
                step = std::max(step, static_cast<double>(std::nextafter(size, INFINITY) - size));
            }
        }
        const double millimetres = asset.state().scale.millimetres_a_unit;
        EXPECT_EQ(asset.float_step_mm(), step * millimetres) << far;
        std::cout << far << ": " << asset.float_step_mm() << " mm\n";
        // No vertex of the picture is farther from where the exact one would be than half of it along each axis.
        const Face exact = face(false);
        for (std::size_t v = 0; v < exact.positions.size(); ++v) {
            const glm::dvec3 off =
                glm::dvec3(file.positions[v]) - (glm::dvec3(exact.positions[v]) + glm::dvec3(out(far)));
            ASSERT_LE(std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}), 0.5 * step);
        }
    }
}

TEST_F(FarVertices, WhatIsReadBackStandsWhereTheFileHasIt) {
    const float far = 1e4F;
    const Face file = baked(face(false), out(far));
    Character character = *Character::create(device_, *FaceAsset::create(file));
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(character));
    EXPECT_EQ(scene.read_deformed(character).positions, file.positions) << "at rest, to the bit";
    for (float& weight : character.controls().first(file.targets.size())) weight = 0.4F;
    const Scene::Surface read = scene.read_deformed(character);
    const PublishedSurface published = character.surface();
    const std::vector<glm::vec3> inside = test::read_buffer<glm::vec3>(published.positions);
    for (std::size_t v = 0; v < inside.size(); ++v) {
        ASSERT_LT(glm::length(inside[v]), 3) << "on the GPU, near the origin";
        const glm::dvec3 world(published.primitives[0].world_from_mesh * glm::dvec4(inside[v], 1));
        ASSERT_LT(glm::length(world - glm::dvec3(read.positions[v])), 2e-3) << "by half a step of the file's";
    }
    // Points and sockets know the place as well.
    const SurfacePoint point = *character.asset().attach({40, {1, 0, 0}});
    const std::uint32_t v = character.face().indices[120];
    EXPECT_LT(glm::length(character.at(point)->position_world -
                          glm::dvec3(published.primitives[0].world_from_mesh * glm::dvec4(inside[v], 1))),
              1e-9);
    const glm::dvec3 head = (*character.socket(Socket::head))[3];
    EXPECT_LT(glm::length(head - glm::dvec3(out(far))), 2);
}

TEST_F(FarVertices, TheHostsJointsAreThoseOfTheFile) {
    const float far = 1e4F;
    Character near = *Character::create(device_, *FaceAsset::create(rounded(face(true), out(far))));
    Character there = *Character::create(device_, *FaceAsset::create(baked(face(true), out(far))));
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(near));
    ASSERT_TRUE(scene.add(there));
    const glm::mat4 turn = glm::rotate(glm::mat4(1), 0.3F, glm::vec3(0, 1, 0));
    const glm::dmat4 away = glm::translate(glm::dmat4(1), glm::dvec3(out(far)));
    ASSERT_TRUE(near.set_joints(std::vector<glm::mat4>{turn, glm::mat4(1)}));
    ASSERT_TRUE(there.set_joints(
        std::vector<glm::mat4>{glm::mat4(away * glm::dmat4(turn) * glm::inverse(away)), glm::mat4(1)}));
    scene.deform();
    const PublishedSurface a = near.surface(), b = there.surface();
    const std::vector<glm::vec3> of_near = test::read_buffer<glm::vec3>(a.positions),
                                 of_far = test::read_buffer<glm::vec3>(b.positions);
    const glm::dmat4 from_near = away * a.primitives[0].world_from_mesh, from_far = b.primitives[0].world_from_mesh;
    for (std::size_t v = 0; v < of_near.size(); ++v) {
        const glm::dvec3 expected(from_near * glm::dvec4(of_near[v], 1)), found(from_far * glm::dvec4(of_far[v], 1));
        ASSERT_LT(glm::length(expected - found), 2e-3) << "the host's own matrix has floats of that step";
    }
}

}  // namespace
}  // namespace blush
