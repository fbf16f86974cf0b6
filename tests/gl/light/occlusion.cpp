// What a face hides of the light from all around, on the GPU, against
// rig/light/occlusion.cpp in double precision.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/environment_map.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 16;

/// A square of white skin, 60 mm wide, that looks along +Z; every vertex has
/// the same transfer. Target "bent" turns its normal and its tangent, not its
/// places.
Face square() {
    Face face;
    face.path = "square";
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        face.positions.emplace_back(0.03F * corner, 0.0F);
        face.normals.emplace_back(0.0F, 0.0F, 1.0F);
        face.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
        face.uv0.emplace_back(0.0F);
        face.uv1.emplace_back(0.0F);
    }
    face.indices = {0, 1, 2, 0, 2, 3};
    Material material;
    material.name = "skin";
    material.metallic = 0;
    face.materials.push_back(material);
    test::add_primitive(face, 0, 0);
    face.meshes.push_back({"mesh", 0, 1});
    Node node;
    node.name = "head";
    node.mesh = 0;
    face.nodes.push_back(node);
    for (const char* name : {"bent", "opened"}) {
        Target target;
        target.name = name;
        for (std::uint32_t v = 0; v < 4; ++v) {
            target.vertices.push_back(v);
            target.position_deltas.emplace_back(0.0F);
            target.normal_deltas.push_back(name == std::string("bent") ? glm::vec3(0.5F, 0.3F, -0.2F) : glm::vec3(0));
            target.tangent_deltas.push_back(name == std::string("bent") ? glm::vec3(-0.1F, 0.4F, 0.2F) : glm::vec3(0));
        }
        face.targets.push_back(target);
    }
    test::find_normal_sources(face);
    return face;
}

/// Hidden to its left, and a little above.
LightTransfer half_hidden() {
    const std::vector<glm::dvec3> directions = cosine_directions(512);
    std::vector<std::uint8_t> hidden;
    for (const glm::dvec3& w : directions) hidden.push_back(w.x > 0.1 || w.y > 0.8 ? 1 : 0);
    return transfer_of(directions, hidden);
}

/// A bright window to the left and a dim room, in three colours.
Lighting room() {
    Image image;
    image.width = 32;
    image.height = 16;
    image.channels = 3;
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            const bool window = x > 18 && x < 24 && y > 3 && y < 9;
            image.floats.insert(image.floats.end(),
                                {window ? 4.0F : 0.5F, window ? 3.5F : 0.6F, 0.7F + 0.02F * static_cast<float>(y)});
        }
    }
    Lighting lighting;
    lighting.environment = *make_environment(image);
    return lighting;
}

/// The darkest side of the map as the roughest mirror sees it.
glm::dvec3 least_of(const Environment& environment) {
    glm::dvec3 least(1e9);
    const std::vector<float>& blurred = environment.levels.back().rgb_linear;
    for (std::size_t i = 0; i < blurred.size(); ++i) {
        double& channel = least[static_cast<glm::length_t>(i % 3)];
        channel = std::min(channel, static_cast<double>(blurred[i]));
    }
    return least;
}

class OcclusionOnTheGpu : public test::GlTest {
protected:
    Portrait plain(Face face, std::optional<OcclusionSet> set) const {
        Portrait character = make_character(std::move(face));
        EXPECT_TRUE(character.set("scattering.method", "off"));
        EXPECT_TRUE(character.set("reflection.intensity", "0"));
        EXPECT_TRUE(character.set("occlusion.bounces", "off"));
        character.set_occlusion(std::move(set));
        return character;
    }
    ViewFrame view_of(const Offscreen& offscreen, const Lighting& lighting) const {
        ViewFrame view = offscreen.view();
        view.samples = 1;
        view.check_finite = true;
        view.camera.view_from_world = glm::lookAt(glm::vec3(0, 0, 0.5F), glm::vec3(0), glm::vec3(0, 1, 0));
        view.camera.clip_from_view = glm::ortho(-0.005F, 0.005F, -0.005F, 0.005F, 0.1F, 1.0F);
        view.lighting = &lighting;
        return view;
    }
    static glm::dvec3 middle(const Image& image) {
        const std::size_t at = 4 * (std::size_t{image.height / 2} * image.width + image.width / 2);
        return {image.floats[at], image.floats[at + 1], image.floats[at + 2]};
    }
};

OcclusionSet same_everywhere(const Face& face, std::vector<std::pair<std::string, LightTransfer>> poses) {
    OcclusionSet set;
    set.face_identity = occlusion_identity(face);
    for (const auto& [name, transfer] : poses)
        set.poses.push_back({name, std::vector<LightTransfer>(face.positions.size(), transfer)});
    return set;
}

/// Half floats of the picture (0.05 %), single precision of the coefficients.
constexpr double gpu_tolerance = 1e-3;

TEST_F(OcclusionOnTheGpu, EqualsTheTwinAtRestDeformedAndTurned) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Lighting lighting = room();
    const LightTransfer hidden = half_hidden();
    const double pi = std::numbers::pi;
    for (const float bend : {0.0F, 0.6F}) {
        for (const float yaw : {0.0F, 0.5F}) {
            for (const float turn : {0.0F, 1.0F}) {
                Face face = square();
                face.nodes[0].rest.rotation =
                    rotation_of(glm::angleAxis(yaw, glm::normalize(glm::vec3(0.2F, 1, 0.1F))));
                Portrait character = plain(face, same_everywhere(face, {{"", hidden}}));
                test::set_weights(character, {bend, 0});
                lighting.environment_turn_radians = turn;
                const ViewFrame view = view_of(offscreen, lighting);
                const glm::dvec3 drawn = middle(test::draw(character, offscreen, view));

                const Scene::Surface surface = character.read_deformed();
                const glm::dmat3 node(glm::mat3_cast(glm_of(face.nodes[0].rest.rotation)));
                const glm::dmat3 frame = vertex_frame(glm::normalize(node * glm::dvec3(surface.normals[0])),
                                                      node * glm::dvec3(surface.tangents[0]));
                const glm::dmat3 about_y(glm::rotate(glm::dmat4(1), static_cast<double>(turn), glm::dvec3(0, 1, 0)));
                const Sh9Color light = rotate(sh_rotation(about_y), lighting.environment->radiance_sh);
                const glm::dvec3 expected = occluded_ambient(light, hidden, frame, least_of(*lighting.environment));
                const glm::dvec3 open = dot(light, clamped_cosine(frame[2])) / pi;
                for (glm::length_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(drawn[c], expected[c], gpu_tolerance * open[c]) << bend << " " << yaw << " " << turn;
                    EXPECT_LT(expected[c], 0.75 * open[c]);
                }
            }
        }
    }
}

TEST_F(OcclusionOnTheGpu, PosesBlendByTheirTargets) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Lighting lighting = room();
    const Face face = square();
    const LightTransfer hidden = half_hidden(),
                        open = transfer_of(cosine_directions(16), std::vector<std::uint8_t>(16, 0));
    Portrait character = plain(face, same_everywhere(face, {{"", hidden}, {"opened", open}}));
    const ViewFrame view = view_of(offscreen, lighting);
    std::vector<glm::dvec3> seen;
    for (const float weight : {0.0F, 0.5F, 1.0F}) {
        test::set_weights(character, {0, weight});
        seen.push_back(middle(test::draw(character, offscreen, view)));
    }
    Portrait without = plain(face, std::nullopt);
    const glm::dvec3 free = middle(test::draw(without, offscreen, view));
    LightTransfer blended{};
    for (std::size_t i = 0; i < 9; ++i) blended[i] = 0.5F * (hidden[i] + open[i]);
    const glm::dvec3 half_way =
        occluded_ambient(lighting.environment->radiance_sh, blended, glm::dmat3(1), least_of(*lighting.environment));
    for (glm::length_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen[2][c], free[c], gpu_tolerance * free[c]);
        EXPECT_NEAR(seen[1][c], half_way[c], gpu_tolerance * free[c]);
        EXPECT_LT(seen[0][c], 0.75 * free[c]);
    }
}

TEST_F(OcclusionOnTheGpu, SkyAndGroundAreHiddenToo) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Lighting lighting;
    lighting.sky_radiance_linear = {0.8F, 0.9F, 1};
    lighting.ground_radiance_linear = {0.3F, 0.2F, 0.1F};
    const Face face = square();
    Portrait character = plain(face, same_everywhere(face, {{"", half_hidden()}}));
    const ViewFrame view = view_of(offscreen, lighting);
    const glm::dvec3 drawn = middle(test::draw(character, offscreen, view));
    Sh9Color light{};  // of a gradient between them
    const Sh9 up = sh_basis({0, 1, 0});
    const glm::dvec3 sky(lighting.sky_radiance_linear), ground(lighting.ground_radiance_linear);
    light[0] = 0.5 * (sky + ground) / up[0];
    light[1] = 0.5 * (sky - ground) / up[1] * 1.5;  // the convolution with the cosine takes a third of band 1
    const glm::dvec3 expected = occluded_ambient(light, half_hidden(), glm::dmat3(1), glm::min(sky, ground));
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(drawn[c], expected[c], gpu_tolerance);

    Face coloured = face;
    coloured.materials[0].base_color_linear = {0.8F, 0.5F, 0.2F, 1};
    Portrait bouncing = plain(coloured, same_everywhere(face, {{"", half_hidden()}}));
    ASSERT_TRUE(bouncing.set("occlusion.bounces", "on"));
    const glm::dvec3 albedo(0.8, 0.5, 0.2), lit = middle(test::draw(bouncing, offscreen, view));
    const glm::dvec3 twin = albedo * with_bounces(expected, openness(half_hidden()), albedo);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(lit[c], twin[c], gpu_tolerance);
}

TEST_F(OcclusionOnTheGpu, AMirrorShowsTheOpenShareOfItsSurroundings) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Lighting lighting = room();
    Face face = square();
    face.materials[0].base_color_linear = {0, 0, 0, 1};
    const ViewFrame view = view_of(offscreen, lighting);
    Portrait hidden = plain(face, same_everywhere(face, {{"", half_hidden()}})), open = plain(face, std::nullopt);
    ASSERT_TRUE(hidden.set("reflection.intensity", "1"));
    ASSERT_TRUE(open.set("reflection.intensity", "1"));
    const glm::dvec3 all = middle(test::draw(open, offscreen, view)),
                     part = middle(test::draw(hidden, offscreen, view));
    ASSERT_GT(all.x, 0.005);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(part[c], openness(half_hidden()) * all[c], 2e-3 * all[c]) << c;
}

TEST_F(OcclusionOnTheGpu, AnOpenFaceIsDrawnAsWithoutAndLampsAreNotHidden) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Face face = square();
    const LightTransfer open = transfer_of(cosine_directions(16), std::vector<std::uint8_t>(16, 0));
    Portrait with = plain(face, same_everywhere(face, {{"", open}})), without = plain(face, std::nullopt);
    Lighting lighting = room();
    ViewFrame view = view_of(offscreen, lighting);
    const Image a = test::draw(with, offscreen, view), b = test::draw(without, offscreen, view);
    for (std::size_t i = 0; i < a.floats.size(); ++i) EXPECT_NEAR(a.floats[i], b.floats[i], 1e-3F);

    Lighting lamp;
    LightSource light;
    light.direction_world = {0, 0, -1};
    lamp.lights = {light};
    view = view_of(offscreen, lamp);
    Portrait dark = plain(face, same_everywhere(face, {{"", half_hidden()}}));
    EXPECT_EQ(test::draw(dark, offscreen, view).floats, test::draw(without, offscreen, view).floats);
    EXPECT_FALSE(dark.state().on(occlusion_effect));
    view.force_effects = true;
    EXPECT_EQ(test::draw(dark, offscreen, view).floats, test::draw(without, offscreen, view).floats);
}

}  // namespace
}  // namespace blush
