// A host shades a character with a program of its own around the library's functions.

#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <string>

#include "runtime/gl/object.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

GLuint compiled(GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    std::array<char, 4096> log{};
    if (ok != GL_TRUE) glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    EXPECT_EQ(ok, GL_TRUE) << log.data();
    return shader;
}

GLuint program_of(const ShadingText& text, const std::string& main) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, text.vertex), compiled(GL_FRAGMENT_SHADER, text.fragment + main)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    EXPECT_EQ(ok, GL_TRUE);
    return program;
}

class HostShading : public test::GlTest {
protected:
    HostShading()
        : asset_(*FaceAsset::create(shaded_face())),
          character_(*Character::create(device_, asset_)),
          scene_(*Scene::create(device_)),
          view_(*View::create(device_)) {
        EXPECT_TRUE(scene_.add(character_));
        EXPECT_TRUE(view_.set("scattering.method", "off"));
        EXPECT_TRUE(view_.set("antialiasing.mode", "none"));
        character_.controls()[0] = 0.6F;
    }
    static Face shaded_face() {
        Face face = test::make_face({.targets = 4, .normal_deltas = true});
        for (Material& material : face.materials) {
            material.skin = true;
            material.double_sided = true;
        }
        return face;
    }
    ViewFrame frame(GLuint framebuffer) const {
        ViewFrame frame;
        frame.width = frame.height = side;
        frame.framebuffer = framebuffer;
        frame.output = Output::linear_hdr;
        frame.background_linear = {0, 0, 0, 1};
        frame.camera = asset_.framing(1).camera(1);
        return frame;
    }
    /// Of the host's own, with depth.
    struct Target {
        gl::Texture color = gl::make_texture(GL_TEXTURE_2D), depth = gl::make_texture(GL_TEXTURE_2D);
        gl::Framebuffer framebuffer = gl::make_framebuffer();

        Target() {
            glTextureStorage2D(color.name(), 1, GL_RGBA32F, side, side);
            glTextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT32F, side, side);
            glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, color.name(), 0);
            glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
        }
        std::vector<float> read() const {
            std::vector<float> values(std::size_t{4} * side * side);
            glGetTextureImage(color.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                              values.data());
            return values;
        }
    };
    void draw_as_a_host(const Target& target, const std::string& main) {
        const FrameReport& report = scene_.prepare(view_, frame(0));
        ASSERT_FALSE(report.failure) << *report.failure;
        const std::array<float, 4> black = {0, 0, 0, 1};
        const float far_depth = 1;
        glClearNamedFramebufferfv(target.framebuffer.name(), GL_COLOR, 0, black.data());
        glClearNamedFramebufferfv(target.framebuffer.name(), GL_DEPTH, 0, &far_depth);
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
        glViewport(0, 0, side, side);
        glEnable(GL_DEPTH_TEST);
        for (std::size_t p = 0; p < asset_.face().primitives.size(); ++p) {
            const Result<ShadingText> text = scene_.shading_text(view_, character_, p);
            ASSERT_TRUE(text) << text.error().message;
            const GLuint program = program_of(*text, main);
            glUseProgram(program);
            ASSERT_TRUE(scene_.bind_shading(view_, character_, p));
            const Primitive& primitive = asset_.face().primitives[p];
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(std::size_t{primitive.first_index} * sizeof(std::uint32_t)));
            glUseProgram(0);
            glDeleteProgram(program);
        }
        glDisable(GL_DEPTH_TEST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }

    FaceAsset asset_;
    Character character_;
    Scene scene_;
    View view_;
};

constexpr const char* plain_main = R"(
layout(location = 0) out vec4 radiance;
void main() {
    Surface s = model_surface(interpolants());
    Lighting lit = model_lighting(s);
    radiance = vec4(lit.reflected + light_from_inside(s, lit), covered(s.opacity));
})";

TEST_F(HostShading, GivesThePictureOfTheLibrarysOwn) {
    const Target theirs, ours;
    draw_as_a_host(theirs, plain_main);
    scene_.draw(view_, frame(ours.framebuffer.name()));
    const std::vector<float> a = theirs.read(), b = ours.read();
    float worst = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        // The library's own picture passes through half floats.
        worst = std::max(worst, std::abs(a[i] - b[i]) / std::max(1e-3F, std::abs(b[i])));
        lit += i % 4 == 0 && a[i] > 0.05F ? 1U : 0U;
    }
    EXPECT_GT(lit, 500U);
    EXPECT_LE(worst, 1.0F / 1024);
}

TEST_F(HostShading, AHostChangesTheRecordBeforeItIsLit) {
    const Target as_it_is, white;
    draw_as_a_host(as_it_is, plain_main);
    draw_as_a_host(white, R"(
layout(location = 0) out vec4 radiance;
void main() {
    Surface s = model_surface(interpolants());
    s.base_color = vec3(1.0);
    Lighting lit = model_lighting(s);
    radiance = vec4(lit.reflected + light_from_inside(s, lit), covered(s.opacity));
})");
    const std::vector<float> a = as_it_is.read(), b = white.read();
    double before = 0, after = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        before += static_cast<double>(a[i + 2]);
        after += static_cast<double>(b[i + 2]);
    }
    EXPECT_GT(after, 1.2 * before);
}

TEST_F(HostShading, WhatIsNotThereIsAnError) {
    scene_.prepare(view_, frame(0));
    const Result<ShadingText> text = scene_.shading_text(view_, character_, 99);
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().message, "the character draws 1 primitives; there is no number 99");
    const Character stranger = *Character::create(device_, asset_);
    EXPECT_FALSE(scene_.bind_shading(view_, stranger, 0));
}

}  // namespace
}  // namespace blush
