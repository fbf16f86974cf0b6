// The surface on the GPU, as a host that draws for itself finds it.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/gl/surface/surface_reading.h"
#include "tests/gl_fixture.h"
#include "tests/rig/count_allocations.h"
#include "tests/rotation.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 96;

/// A program of a host's own: nothing but positions.
GLuint plain_program() {
    const auto shader = [](GLenum kind, const char* text) {
        const GLuint name = glCreateShader(kind);
        glShaderSource(name, 1, &text, nullptr);
        glCompileShader(name);
        return name;
    };
    const GLuint program = glCreateProgram();
    const GLuint vertex = shader(GL_VERTEX_SHADER, R"(#version 450 core
        layout(location = 0) in vec3 position;
        layout(location = 0) uniform mat4 clip_from_mesh;
        void main() { gl_Position = clip_from_mesh * vec4(position, 1.0); })");
    const GLuint fragment = shader(GL_FRAGMENT_SHADER, "#version 450 core\nvoid main() {}");
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    EXPECT_EQ(linked, GL_TRUE);
    return program;
}

class DepthTarget {
public:
    DepthTarget() {
        glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
        glTextureStorage2D(texture_, 1, GL_DEPTH_COMPONENT32F, side, side);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, texture_, 0);
        const float far_depth = 1;
        glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_depth);
    }
    ~DepthTarget() {
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteTextures(1, &texture_);
    }
    DepthTarget(const DepthTarget&) = delete;
    DepthTarget& operator=(const DepthTarget&) = delete;
    GLuint framebuffer() const { return framebuffer_; }
    std::vector<float> read() const {
        std::vector<float> values(std::size_t{side} * side);
        glGetTextureImage(texture_, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
        return values;
    }

private:
    GLuint texture_ = 0, framebuffer_ = 0;
};

/// As a host would: its own vertex array over the published buffers.
void draw_plainly(const PublishedSurface& surface, const glm::dmat4& clip_from_world, GLuint framebuffer) {
    const GLuint program = plain_program();
    GLuint array = 0;
    glCreateVertexArrays(1, &array);
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, static_cast<GLint>(surface.positions.components), GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glVertexArrayVertexBuffer(array, 0, surface.positions.name, 0,
                              static_cast<GLsizei>(surface.positions.stride_bytes));
    glVertexArrayElementBuffer(array, surface.indices);
    glBindVertexArray(array);
    glUseProgram(program);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, side, side);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    for (const SurfacePrimitive& primitive : surface.primitives) {
        const glm::mat4 clip_from_mesh(clip_from_world * primitive.world_from_mesh);
        glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_mesh[0].x);
        glFrontFace(primitive.mirrored ? GL_CW : GL_CCW);
        const std::size_t offset = std::size_t{primitive.first_index} * sizeof(std::uint32_t);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): GL's own way
    }
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    glDeleteVertexArrays(1, &array);
    glDeleteProgram(program);
}

class Published : public test::GlTest {
protected:
    static Face face_of(bool joints) {
        Face face = test::make_face({.targets = 6, .two_primitives = true, .seam = true, .joints = joints});
        face.nodes[0].rest.translation = {0.1F, 0.2F, 0.3F};
        face.nodes[0].rest.rotation = rotation_of(glm::angleAxis(0.2F, glm::vec3(0, 1, 0)));
        return face;
    }
};

TEST_F(Published, AHostThatDrawsItGetsTheDepthThatTheLibraryDraws) {
    for (const bool joints : {false, true}) {
        const FaceAsset asset = *FaceAsset::create(face_of(joints));
        std::vector<Character> characters;
        Scene scene = *Scene::create(device_);
        for (const double x : {-0.6, 0.7}) {
            characters.push_back(*Character::create(device_, asset));
            // The second one is mirrored.
            characters.back().place(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, 0)) *
                                    glm::scale(glm::dmat4(1), glm::dvec3(x > 0 ? -1 : 1, 1, 1)));
            ASSERT_TRUE(scene.add(characters.back()));
        }
        OrbitCamera orbit = asset.framing(1);
        orbit.distance *= 1.5F;
        orbit.yaw_radians = 0.3F;
        const Camera camera = orbit.camera(1);
        const glm::dmat4 clip_from_world = glm::dmat4(camera.clip_from_view) * camera.view_from_world;
        for (int pose = 0; pose < 3; ++pose) {
            for (Character& character : characters)
                for (float& control : character.controls()) control = 0.4F * static_cast<float>(pose);
            const DepthTarget theirs, ours;
            DepthFrame depth;
            depth.clip_from_world = clip_from_world;
            depth.width = depth.height = side;
            depth.framebuffer = ours.framebuffer();
            scene.draw_depth(depth);
            const FrameReport& report = scene.deform();
            EXPECT_FALSE(report.failure);
            EXPECT_EQ(report.characters.size(), 2U);
            for (const Character& character : characters)
                draw_plainly(character.surface(), clip_from_world, theirs.framebuffer());
            const std::vector<float> a = ours.read(), b = theirs.read();
            std::size_t covered = 0;
            for (std::size_t p = 0; p < a.size(); ++p) {
                covered += a[p] < 1 ? 1U : 0U;
                ASSERT_EQ(a[p] < 1, b[p] < 1) << "the outline, at pixel " << p;
                ASSERT_NEAR(a[p], b[p], 1e-6F) << "pixel " << p;
            }
            EXPECT_GT(covered, 500U);
        }
    }
}

TEST_F(Published, HoldsWhatReadDeformedReads) {
    const FaceAsset asset = *FaceAsset::create(face_of(false));
    Character character = *Character::create(device_, asset);
    EXPECT_EQ(character.surface().positions.name, 0U) << "nothing was deformed yet";
    EXPECT_TRUE(character.surface().primitives.empty());
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(character));
    const Face& face = asset.face();
    for (const float weight : {0.0F, 0.5F, 0.0F, 1.0F}) {
        for (float& control : character.controls()) control = weight;
        scene.deform();
        const PublishedSurface surface = character.surface();
        EXPECT_EQ(surface.positions.count, face.positions.size());
        EXPECT_EQ(surface.positions.stride_bytes, 12U);
        EXPECT_EQ(surface.tangents.stride_bytes, 16U);
        EXPECT_EQ(surface.uv0.stride_bytes, 8U);
        const Scene::Surface published = test::read_published(surface);
        const Scene::Surface read = scene.read_deformed(character);
        EXPECT_EQ(published.positions, read.positions);
        EXPECT_EQ(published.normals, read.normals);
        EXPECT_EQ(published.tangents, read.tangents);
        EXPECT_EQ(test::read_buffer<glm::vec2>(surface.uv0), face.uv0);
        EXPECT_EQ(test::read_buffer<glm::vec2>(surface.uv1), face.uv1);
        std::vector<std::uint32_t> indices(surface.index_count);
        glGetNamedBufferSubData(surface.indices, 0, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                                indices.data());
        EXPECT_EQ(indices, face.indices);
        ASSERT_EQ(surface.primitives.size(), 2U);
        for (std::size_t p = 0; p < 2; ++p) {
            EXPECT_EQ(surface.primitives[p].first_index, face.primitives[p].first_index);
            EXPECT_EQ(surface.primitives[p].index_count, face.primitives[p].index_count);
            EXPECT_EQ(surface.primitives[p].material, face.primitives[p].material);
            EXPECT_EQ(surface.primitives[p].node, 0U);
        }
    }
    // A draw publishes too, and what is asked between frames does not disturb what it left.
    View view = *View::create(device_);
    const Offscreen offscreen = make_offscreen(32, 32);
    ViewFrame frame = offscreen.view();
    frame.camera = asset.framing(1).camera(1);
    character.place(glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 3)));
    scene.draw(view, frame);
    const glm::dmat4 drawn = character.surface().primitives[0].world_from_mesh;
    character.place(glm::dmat4(1));
    (void)character.socket(Socket::head);
    EXPECT_EQ(character.surface().primitives[0].world_from_mesh, drawn);
}

TEST_F(Published, CostsNoMemoryInASteadyFrame) {
    const FaceAsset asset = *FaceAsset::create(face_of(true));
    Character character = *Character::create(device_, asset);
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(character));
    const auto frame = [&](int number) {
        for (float& control : character.controls()) control = 0.1F + 0.01F * static_cast<float>(number);
        scene.deform();
        EXPECT_EQ(character.surface().primitives.size(), 2U);
    };
    for (int warm = 0; warm < 4; ++warm) frame(warm);
    const std::size_t before = test::allocation_count();
    for (int steady = 4; steady < 8; ++steady) frame(steady);
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace blush
