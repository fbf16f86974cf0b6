// What a scene's characters cost beside their pictures: memory and allocations, and whose context their objects go in.

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/device_state.h"
#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"
#include "tests/rig/count_allocations.h"

namespace blush {
namespace {

class SceneCosts : public test::GlTest {};

TEST_F(SceneCosts, ASteadyFrameAllocatesNothing) {
    const FaceAsset asset = *FaceAsset::create(test::make_face({.targets = 6, .normal_deltas = true, .seam = true}));
    for (const std::size_t count : {1U, 5U}) {
        for (const char* mode : {"view", "smaa_1x", "smaa_t2x", "smaa_4x"}) {
            Scene scene = *Scene::create(device_);
            View view = *View::create(device_);
            for (const auto& [setting, value] : {std::pair("antialiasing.mode", mode),
                                                 {"bloom.strength", "0.1"},
                                                 {"depth_of_field.f_number", "2"},
                                                 {"grain.strength", "0.02"},
                                                 {"exposure.mode", "automatic"}}) {
                ASSERT_TRUE(view.set(setting, value));
            }
            std::vector<Character> characters;
            for (std::size_t c = 0; c < count; ++c) {
                characters.push_back(*Character::create(device_, asset));
                characters.back().place(glm::translate(glm::dmat4(1), glm::dvec3(0.4 * static_cast<double>(c), 0, 0)));
                ASSERT_TRUE(scene.add(characters.back()));
            }
            const Offscreen offscreen = make_offscreen(64, 64);
            ViewFrame frame = offscreen.view();
            frame.camera = asset.framing(1).camera(1);
            const auto draw = [&](int number) {
                frame.time_seconds = 0.04 * number;
                for (Character& character : characters) {
                    for (float& control : character.controls()) control = 0.3F + 0.02F * static_cast<float>(number);
                }
                const FrameReport& report = scene.draw(view, frame);
                EXPECT_FALSE(report.failure);
            };
            for (int warm = 0; warm < 4; ++warm) draw(warm);
            const std::size_t before = test::allocation_count();
            for (int steady = 4; steady < 8; ++steady) draw(steady);
            EXPECT_EQ(test::allocation_count() - before, 0U) << count << " characters, " << mode;
        }
    }
}

/// A light with a shadow map of the host's, a probe and an environment.
Lighting all_kinds_of_light(GLuint shadow_map) {
    Image sky;
    sky.width = 8;
    sky.height = 4;
    sky.channels = 3;
    sky.floats.assign(std::size_t{8} * 4 * 3, 0.4F);
    Lighting lighting;
    lighting.environment = *make_environment(sky);
    LightSource light;
    light.direction_world = {-0.5F, -0.3F, -1};
    light.host_shadow.depth_texture = shadow_map;
    lighting.lights = {light};
    LightProbe probe;
    probe.reach = 1e3;
    lighting.probes = {probe};
    return lighting;
}

/// Some of its vertices on a body that has them where they are at rest. (The default face's bust is closed: it has no
/// border.)
void pin_some(Character& character) {
    const std::vector<std::uint32_t> border = {0, 1, 2};
    std::vector<Vec3> positions, normals;
    for (const std::uint32_t v : border) {
        positions.push_back(character.face().positions[v]);
        normals.push_back(character.face().normals[v]);
    }
    ASSERT_TRUE(character.pin(border, 20));
    ASSERT_TRUE(character.move_pins(positions, normals));
}

TEST_F(SceneCosts, NoEffectAllocatesInASteadyFrame) {
    const FaceAsset asset = *FaceAsset::load(std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb");
    const gl::Texture map = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(map.name(), 1, GL_DEPTH_COMPONENT32F, 16, 16);
    std::set<std::string_view> on;
    for (const auto& [mode, count] : {std::pair("msaa4", 1), {"supersampled", 1}, {"smaa_4x", 5}}) {
        Scene scene = *Scene::create(device_);
        View view = *View::create(device_);
        scene.set_lighting(all_kinds_of_light(map.name()));
        ASSERT_TRUE(scene.set("shadows.size", "512"));
        for (const auto& [setting, value] : {std::pair("antialiasing.mode", mode),
                                             {"supersampling.factor", "2"},
                                             {"bloom.strength", "0.1"},
                                             {"depth_of_field.f_number", "2"},
                                             {"grain.strength", "0.02"},
                                             {"exposure.mode", "automatic"}}) {
            ASSERT_TRUE(view.set(setting, value));
        }
        std::vector<Character> characters;
        for (int c = 0; c < count; ++c) {
            characters.push_back(*Character::create(device_, asset));
            ASSERT_TRUE(characters.back().set("normals.source", c == 0 ? "recomputed" : "authored"));
            pin_some(characters.back());
            ASSERT_TRUE(scene.add(characters.back()));
        }
        const Offscreen offscreen = make_offscreen(32, 32);
        ViewFrame frame = offscreen.view();
        frame.camera = asset.framing(1).camera(1);
        const auto draw = [&](int number) {
            frame.time_seconds = 0.04 * number;
            for (Character& character : characters) {
                for (float& control : character.controls()) control = 0.3F + 0.02F * static_cast<float>(number);
            }
            const FrameReport& report = scene.draw(view, frame);
            EXPECT_FALSE(report.failure);
            return &report;
        };
        for (int warm = 0; warm < 4; ++warm) draw(warm);
        const std::size_t before = test::allocation_count();
        const FrameReport* report = nullptr;
        for (int steady = 4; steady < 6; ++steady) report = draw(steady);
        EXPECT_EQ(test::allocation_count() - before, 0U) << count << " characters, " << mode;
        for (const EffectReport& effect : report->effects) {
            if (effect.on) on.insert(effect.effect);
        }
    }
    for (const Effect* effect : effects()) {
        // The face has no joints; test::add_two_joints() is what tests of them have.
        if (effect->need == nullptr && effect->character_need == nullptr) continue;
        if (effect->name == "skinning") continue;
        EXPECT_TRUE(on.contains(effect->name)) << effect->name;
    }
}

TEST_F(SceneCosts, FurtherCharactersOfAnAssetTakeLittleMemory) {
    const std::filesystem::path path = std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb";
    const Result<FaceAsset> asset = FaceAsset::load(path);
    ASSERT_TRUE(asset) << asset.error().message;
    std::vector<Character> characters;
    characters.push_back(*Character::create(device_, *asset));
    // This driver keeps its buffers on the same heap, so what the allocator holds is all of it.
    const auto held = [] {
        const struct mallinfo2 info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const std::size_t before = held();
    for (int c = 1; c < 20; ++c) characters.push_back(*Character::create(device_, *asset));
    const std::size_t each = (held() - before) / 19;
    std::cout << "a further character: " << each << " bytes\n";
    EXPECT_LE(each, std::size_t{3} << 20);
    for (const Character& character : characters) {
        EXPECT_EQ(character.state().model, characters[0].state().model);
    }
}

/// A context of a host's own.
class OtherContext {
public:
    OtherContext() {
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        eglInitialize(display_, nullptr, nullptr);
        eglBindAPI(EGL_OPENGL_API);
        constexpr std::array<EGLint, 5> attributes = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                                      EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    }
    ~OtherContext() {
        release();
        eglDestroyContext(display_, context_);
    }
    OtherContext(const OtherContext&) = delete;
    OtherContext& operator=(const OtherContext&) = delete;
    void make_current() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }
    void release() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    bool is_current() const { return eglGetCurrentContext() == context_; }

private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// Names of everything that GL counts, of which a context has so many.
std::size_t living_objects() {
    std::size_t count = 0;
    for (GLuint name = 1; name < 4096; ++name) {
        for (const GLboolean lives : {glIsBuffer(name), glIsTexture(name), glIsFramebuffer(name), glIsVertexArray(name),
                                      glIsProgram(name), glIsSampler(name)}) {
            count += lives == GL_TRUE ? 1U : 0U;
        }
    }
    return count;
}

TEST_F(SceneCosts, WhatGoesWhileAnotherContextOrNoneIsCurrentHarmsNobody) {
    const FaceAsset asset = *FaceAsset::create(test::make_face({.targets = 2}));
    const OtherContext host, stranger;
    for (const bool none : {false, true}) {
        host.make_current();
        std::optional<Device> adopted = *Device::adopt_current();
        std::optional<Character> character = *Character::create(*adopted, asset);
        std::optional<Scene> scene = *Scene::create(*adopted);
        std::optional<View> view = *View::create(*adopted);
        ASSERT_TRUE(scene->add(*character));
        const std::size_t in_host = [&] {
            const Offscreen offscreen = *Offscreen::create(*adopted, 16, 16, Output::display_srgb);
            ViewFrame frame = offscreen.view();
            frame.camera = asset.framing(1).camera(1);
            scene->draw(*view, frame);
            return living_objects();
        }();
        // Objects of the stranger, whose names are those of the host's.
        stranger.make_current();
        std::vector<gl::Buffer> buffers;
        std::vector<gl::Texture> textures;
        for (int i = 0; i < 200; ++i) {
            buffers.push_back(gl::make_buffer(16, nullptr));
            textures.push_back(gl::make_texture(GL_TEXTURE_2D));
        }
        const std::size_t before = living_objects();
        if (none) stranger.release();
        character.reset();
        view.reset();
        scene.reset();
        if (none) stranger.make_current();
        EXPECT_TRUE(stranger.is_current());
        EXPECT_EQ(living_objects(), before) << "the stranger's objects stand";
        buffers.clear();
        textures.clear();
        // Back in their own context they go when the device is next used.
        host.make_current();
        adopted->make_current();
        EXPECT_LT(living_objects(), in_host);
        stranger.make_current();
        const std::size_t still = living_objects();
        adopted.reset();
        EXPECT_EQ(living_objects(), still) << "nor do the device's programs take the stranger's along";
        host.make_current();
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        host.release();
    }
}

TEST_F(SceneCosts, AThousandCharactersComeAndGoWithoutATrace) {
    const FaceAsset asset = *FaceAsset::create(test::make_face({.side = 8, .targets = 2}));
    Scene scene = *Scene::create(device_);
    View view = *View::create(device_);
    const Offscreen offscreen = make_offscreen(8, 8);
    ViewFrame frame = offscreen.view();
    frame.camera = asset.framing(1).camera(1);
    frame.samples = 1;
    const auto round = [&] {
        Character passing = *Character::create(device_, asset);
        passing.controls()[0] = 0.5F;
        EXPECT_TRUE(scene.add(passing));
        scene.draw(view, frame);
    };
    for (int warm = 0; warm < 5; ++warm) round();
    scene.draw(view, frame);
    const std::size_t objects = living_objects();
    for (int i = 0; i < 1000; ++i) round();
    scene.draw(view, frame);
    EXPECT_EQ(living_objects(), objects);
    EXPECT_LE(device_.state().models.size(), 1U);
}

}  // namespace
}  // namespace blush
