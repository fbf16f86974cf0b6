// What comes in from a host's world and goes out to it: shadows of its geometry, probes, velocities, its state.

#include <epoxy/gl.h>

#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

class HostWorld : public test::GlTest {
protected:
    HostWorld()
        : asset_(*FaceAsset::create(test::make_face({.targets = 4, .normal_deltas = true}))),
          character_(*Character::create(device_, asset_)),
          scene_(*Scene::create(device_)),
          view_(*View::create(device_)),
          offscreen_(make_offscreen(side, side)) {
        EXPECT_TRUE(scene_.add(character_));
        // What scatters would carry light over the edge of a shadow.
        EXPECT_TRUE(view_.set("scattering.method", "off"));
        EXPECT_TRUE(view_.set("antialiasing.mode", "none"));
    }
    ViewFrame frame() const {
        ViewFrame frame = offscreen_.view();
        frame.camera = asset_.framing(1).camera(1);
        frame.check_finite = true;
        return frame;
    }
    std::vector<std::uint8_t> drawn(const ViewFrame& frame) {
        const FrameReport& report = scene_.draw(view_, frame);
        EXPECT_FALSE(report.failure) << *report.failure;
        if (report.not_finite) ADD_FAILURE() << report.not_finite->sentence();
        return offscreen_.read().bytes;
    }
    std::vector<std::uint8_t> drawn() { return drawn(frame()); }
    bool is_on(std::string_view effect) const {
        for (const EffectReport& report : Scene::report(view_).characters[0].effects) {
            if (report.effect == effect) return report.on;
        }
        ADD_FAILURE() << "no report of " << effect;
        return false;
    }
    static Lighting lamp() {
        LightSource light;
        light.direction_world = {0, 0, -1};
        light.casts_shadow = false;
        Lighting lighting;
        lighting.lights = {light};
        lighting.sky_radiance_linear = lighting.ground_radiance_linear = glm::vec3(0.1F);
        return lighting;
    }

    FaceAsset asset_;
    Character character_;
    Scene scene_;
    View view_;
    Offscreen offscreen_;
};

/// Bytes of the left or the right half of a picture, without `margin` columns beside the middle.
std::vector<std::uint8_t> half(const std::vector<std::uint8_t>& picture, bool right, std::uint32_t margin = 2) {
    std::vector<std::uint8_t> bytes;
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const bool in = right ? x >= side / 2 + margin : x < side / 2 - margin;
            const auto at = picture.begin() + 4 * (std::ptrdiff_t{y} * side + x);
            if (in) bytes.insert(bytes.end(), at, at + 4);
        }
    }
    return bytes;
}

/// Bytes of one half that differ by more than the rounding of nine texels' mean.
std::size_t differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, bool right) {
    const std::vector<std::uint8_t> x = half(a, right), y = half(b, right);
    std::size_t count = 0;
    for (std::size_t i = 0; i < x.size(); ++i) count += std::abs(int{x[i]} - int{y[i]}) > 1 ? 1U : 0U;
    return count;
}
constexpr bool left = false, right = true;

/// A depth texture whose left half is a wall right before the light, whose right half is empty.
gl::Texture wall_on_the_left(bool reversed, GLenum format = GL_DEPTH_COMPONENT32F) {
    constexpr GLsizei map_side = 1024;  // a texel is a thousandth of the face, and so is the step off its surface
    gl::Texture map = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(map.name(), 1, format, map_side, map_side);
    std::vector<float> depth(std::size_t{map_side} * map_side);
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = (i % map_side < map_side / 2) == reversed ? 1.0F : 0.0F;
    glTextureSubImage2D(map.name(), 0, 0, 0, map_side, map_side, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
    // The host samples it in a way of its own.
    glTextureParameteri(map.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    return map;
}

TEST_F(HostWorld, AWallOfTheHostsHidesALightInEveryConventionOfDepth) {
    scene_.set_lighting(lamp());
    const std::vector<std::uint8_t> lit = drawn();
    EXPECT_FALSE(is_on("host_shadows"));
    Lighting dark = lamp();
    dark.lights.clear();
    scene_.set_lighting(dark);
    const std::vector<std::uint8_t> unlit = drawn();
    ASSERT_GT(differing(lit, unlit, left), 1000U);

    constexpr std::array<GLenum, 3> formats = {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8};
    for (const bool zero_to_one : {false, true}) {
        for (const bool reversed : {false, true}) {
            for (const GLenum format : formats) {
                const gl::Texture map = wall_on_the_left(reversed, format);
                Lighting lighting = lamp();
                HostShadow& shadow = lighting.lights[0].host_shadow;
                shadow.depth_texture = map.name();
                shadow.depth_convention = {zero_to_one, reversed};
                glm::dmat4 clip = glm::ortho(-3.0, 3.0, -3.0, 3.0, 0.1, 20.0) *
                                  glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
                for (glm::length_t c = 0; c < 4; ++c) {
                    if (reversed) clip[c][2] = -clip[c][2];
                    if (zero_to_one) clip[c][2] = 0.5 * (clip[c][2] + clip[c][3]);
                }
                shadow.clip_from_world = clip;
                scene_.set_lighting(lighting);
                const std::vector<std::uint8_t> shadowed = drawn();
                EXPECT_TRUE(is_on("host_shadows"));
                EXPECT_EQ(differing(shadowed, lit, right), 0U) << zero_to_one << reversed;
                EXPECT_EQ(differing(shadowed, unlit, left), 0U) << zero_to_one << reversed;
            }
        }
    }
    ASSERT_TRUE(scene_.set("host_shadows.method", "off"));
    EXPECT_TRUE(drawn() == lit);
}

TEST_F(HostWorld, EachOfFourLightsHasAMapOfItsOwnAndAFifthHasNone) {
    const gl::Texture wall = wall_on_the_left(false), open = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(open.name(), 1, GL_DEPTH_COMPONENT32F, 16, 16);
    const float far_depth = 1;
    glClearTexImage(open.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far_depth);
    const auto lighting_with = [&](std::size_t lights, std::size_t walled) {
        Lighting lighting = lamp();
        lighting.lights.resize(lights, lighting.lights[0]);
        for (std::size_t l = 0; l < lights; ++l) {
            lighting.lights[l].radiance_linear = glm::vec3(0.1F * static_cast<float>(l + 1));
            lighting.lights[l].host_shadow.depth_texture = l == walled ? wall.name() : open.name();
            lighting.lights[l].host_shadow.clip_from_world =
                glm::ortho(-3.0, 3.0, -3.0, 3.0, 0.1, 20.0) *
                glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
        }
        return lighting;
    };
    for (std::size_t walled = 0; walled < 5; ++walled) {
        scene_.set_lighting(lighting_with(5, walled));
        const std::vector<std::uint8_t> shadowed = drawn();
        Lighting without = lighting_with(5, walled);
        if (walled < 4) without.lights[walled].radiance_linear = glm::vec3(0);
        scene_.set_lighting(without);
        EXPECT_EQ(differing(shadowed, drawn(), left), 0U) << walled;
    }
}

TEST_F(HostWorld, AProbeLightsLikeTheSkyThatItStandsFor) {
    Lighting sky;
    sky.sky_radiance_linear = sky.ground_radiance_linear = glm::vec3(0.6F, 0.4F, 0.2F);
    scene_.set_lighting(sky);
    const std::vector<std::uint8_t> under_sky = drawn();
    EXPECT_FALSE(is_on("probes"));
    Lighting probes;
    LightProbe probe;
    probe.reach = 1e6;
    probe.radiance_sh[0] = DVec3(0.6, 0.4, 0.2) / sh_basis({0, 1, 0})[0];
    probes.probes = {probe};
    scene_.set_lighting(probes);
    const std::vector<std::uint8_t> among_probes = drawn();
    EXPECT_TRUE(is_on("probes"));
    int worst = 0;
    for (std::size_t i = 0; i < under_sky.size(); ++i)
        worst = std::max(worst, std::abs(int{under_sky[i]} - int{among_probes[i]}));
    EXPECT_LE(worst, 1);
    // Two in one place share what they light.
    probes.probes.push_back(probe);
    scene_.set_lighting(probes);
    const std::vector<std::uint8_t> of_two = drawn();
    for (std::size_t i = 0; i < of_two.size(); ++i) ASSERT_LE(std::abs(int{of_two[i]} - int{among_probes[i]}), 1);
}

TEST_F(HostWorld, AProbeOutOfReachChangesNothing) {
    Lighting lighting = lamp();
    scene_.set_lighting(lighting);
    const std::vector<std::uint8_t> without = drawn();
    LightProbe probe;
    probe.position_world = {0, 0, 100};
    probe.reach = 50;
    probe.radiance_sh[0] = DVec3(10);
    lighting.probes = {probe};
    scene_.set_lighting(lighting);
    EXPECT_TRUE(drawn() == without);
    EXPECT_FALSE(is_on("probes"));
    lighting.probes[0].reach = 1000;
    scene_.set_lighting(lighting);
    EXPECT_TRUE(drawn() != without);
}

/// A host's velocities, filled with what no velocity is.
class VelocityTarget {
public:
    VelocityTarget() {
        glTextureStorage2D(texture_.name(), 1, GL_RG16F, side, side);
        glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
        clear();
    }
    void clear() const {
        const std::array<float, 4> untouched = {9, 9, 9, 9};
        glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, untouched.data());
    }
    GLuint name() const { return framebuffer_.name(); }
    std::vector<glm::vec2> read() const {
        std::vector<glm::vec2> values(std::size_t{side} * side);
        glGetTextureImage(texture_.name(), 0, GL_RG, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(glm::vec2)),
                          values.data());
        return values;
    }

private:
    gl::Texture texture_ = gl::make_texture(GL_TEXTURE_2D);
    gl::Framebuffer framebuffer_ = gl::make_framebuffer();
};

TEST_F(HostWorld, VelocitiesTellHowTheCharactersMovedAndSpareTheRest) {
    for (const char* mode : {"none", "msaa4", "smaa_t2x", "smaa_4x"}) {
        ASSERT_TRUE(view_.set("antialiasing.mode", mode));
        const VelocityTarget target;
        ViewFrame frame = this->frame();
        // Straight on and without perspective a move in the world is the same move everywhere.
        frame.camera.view_from_world = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -5));
        frame.camera.clip_from_view = glm::ortho(-2.0F, 2.0F, -2.0F, 2.0F, 0.1F, 20.0F);
        frame.velocity_framebuffer = target.name();
        frame.cut = true;
        character_.place(glm::dmat4(1));
        drawn(frame);
        for (const glm::vec2& value : target.read()) ASSERT_EQ(value, glm::vec2(9)) << "a first frame has none";
        frame.cut = false;
        character_.place(glm::translate(glm::dmat4(1), glm::dvec3(0.125, -0.0625, 0)));
        drawn(frame);
        std::size_t of_face = 0;
        for (const glm::vec2& value : target.read()) {
            if (value == glm::vec2(9)) continue;
            ++of_face;
            ASSERT_NEAR(value.x, 0.125F / 4, 1e-4F) << mode;
            ASSERT_NEAR(value.y, -0.0625F / 4, 1e-4F) << mode;
        }
        EXPECT_GT(of_face, 200U);
        EXPECT_LT(of_face, std::size_t{side} * side);
        target.clear();
        drawn(frame);
        std::size_t still = 0;
        for (const glm::vec2& value : target.read()) still += value == glm::vec2(0) ? 1U : 0U;
        EXPECT_EQ(still, of_face) << "what stands still has a velocity of zero";
    }
}

TEST_F(HostWorld, WhatTheHostHidesHasNoVelocity) {
    const gl::Texture color = gl::make_texture(GL_TEXTURE_2D), depth = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(color.name(), 1, GL_RGBA8, side, side);
    glTextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT24, side, side);
    const gl::Framebuffer host = gl::make_framebuffer();
    glNamedFramebufferTexture(host.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
    glNamedFramebufferTexture(host.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    std::vector<float> wall(std::size_t{side} * side);
    for (std::size_t p = 0; p < wall.size(); ++p) wall[p] = p % side < side / 2 ? 0.0F : 1.0F;
    glTextureSubImage2D(depth.name(), 0, 0, 0, side, side, GL_DEPTH_COMPONENT, GL_FLOAT, wall.data());
    const VelocityTarget target;
    ViewFrame frame = this->frame();
    frame.framebuffer = host.name();
    frame.backdrop = Backdrop::keep;
    frame.host_depth = HostDepth::read;
    frame.velocity_framebuffer = target.name();
    for (const double x : {0.0, 0.05}) {
        character_.place(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)));
        EXPECT_FALSE(scene_.draw(view_, frame).failure);
    }
    const std::vector<glm::vec2> values = target.read();
    std::size_t seen = 0;
    for (std::size_t p = 0; p < values.size(); ++p) {
        if (values[p] == glm::vec2(9)) continue;
        ASSERT_GE(p % side, side / 2) << "behind the wall";
        EXPECT_GT(values[p].x, 0);
        ++seen;
    }
    EXPECT_GT(seen, 200U);
}

TEST_F(HostWorld, OneKeptStateServesSeveralDraws) {
    const std::vector<std::uint8_t> alone = drawn();
    glEnable(GL_CULL_FACE);
    glBindTextureUnit(23, 0);
    const gl::Texture mine = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(mine.name(), 1, GL_RGBA8, 1, 1);
    glBindTextureUnit(3, mine.name());
    {
        const HostState kept(device_);
        EXPECT_TRUE(drawn() == alone);
        character_.controls()[0] = 1;
        EXPECT_TRUE(drawn() != alone);
        character_.controls()[0] = 0;
        EXPECT_TRUE(drawn() == alone);
    }
    EXPECT_EQ(glIsEnabled(GL_CULL_FACE), GL_TRUE);
    GLint bound = 0;
    glActiveTexture(GL_TEXTURE3);
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    EXPECT_EQ(static_cast<GLuint>(bound), mine.name());
    glActiveTexture(GL_TEXTURE0);
    glDisable(GL_CULL_FACE);
    EXPECT_TRUE(drawn() == alone);
}

}  // namespace
}  // namespace blush
