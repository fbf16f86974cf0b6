// Scene::draw leaves the host's GL state as it found it, and is not disturbed by it.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "runtime/gl/object.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr GLuint units = 24, block_bindings = 8, draw_buffers = 8, viewports = 16;

// Every capability of GL 4.5 core that is not indexed.
constexpr GLenum switches[] = {
    GL_COLOR_LOGIC_OP,
    GL_CULL_FACE,
    GL_DEPTH_CLAMP,
    GL_DEPTH_TEST,
    GL_DITHER,
    GL_FRAMEBUFFER_SRGB,
    GL_LINE_SMOOTH,
    GL_MULTISAMPLE,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE,
    GL_POLYGON_OFFSET_POINT,
    GL_POLYGON_SMOOTH,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_RASTERIZER_DISCARD,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_SHADING,
    GL_SAMPLE_MASK,
    GL_STENCIL_TEST,
    GL_TEXTURE_CUBE_MAP_SEAMLESS,
    GL_PROGRAM_POINT_SIZE,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE0 + 1,
    GL_CLIP_DISTANCE0 + 2,
    GL_CLIP_DISTANCE0 + 3,
    GL_CLIP_DISTANCE0 + 4,
    GL_CLIP_DISTANCE0 + 5,
    GL_CLIP_DISTANCE0 + 6,
    GL_CLIP_DISTANCE0 + 7,
};

struct Value {
    GLenum name;
    const char* text;
    int count = 1;
};
constexpr Value values[] = {
    {GL_ACTIVE_TEXTURE, "active texture"},
    {GL_ARRAY_BUFFER_BINDING, "array buffer"},
    {GL_ATOMIC_COUNTER_BUFFER_BINDING, "atomic counter buffer"},
    {GL_CLAMP_READ_COLOR, "clamp read color"},
    {GL_CLIP_DEPTH_MODE, "clip depth mode"},
    {GL_CLIP_ORIGIN, "clip origin"},
    {GL_COLOR_CLEAR_VALUE, "clear color", 4},
    {GL_COPY_READ_BUFFER_BINDING, "copy read buffer"},
    {GL_COPY_WRITE_BUFFER_BINDING, "copy write buffer"},
    {GL_CULL_FACE_MODE, "cull face mode"},
    {GL_CURRENT_PROGRAM, "program"},
    {GL_DEPTH_CLEAR_VALUE, "clear depth"},
    {GL_DEPTH_FUNC, "depth function"},
    {GL_DEPTH_WRITEMASK, "depth mask"},
    {GL_DISPATCH_INDIRECT_BUFFER_BINDING, "dispatch indirect buffer"},
    {GL_DRAW_FRAMEBUFFER_BINDING, "draw framebuffer"},
    {GL_DRAW_INDIRECT_BUFFER_BINDING, "draw indirect buffer"},
    {GL_FRONT_FACE, "front face"},
    {GL_LOGIC_OP_MODE, "logic op"},
    {GL_MIN_SAMPLE_SHADING_VALUE, "min sample shading"},
    {GL_PACK_ALIGNMENT, "pack alignment"},
    {GL_PACK_IMAGE_HEIGHT, "pack image height"},
    {GL_PACK_LSB_FIRST, "pack lsb first"},
    {GL_PACK_ROW_LENGTH, "pack row length"},
    {GL_PACK_SKIP_PIXELS, "pack skip pixels"},
    {GL_PACK_SKIP_ROWS, "pack skip rows"},
    {GL_PACK_SWAP_BYTES, "pack swap bytes"},
    {GL_PATCH_VERTICES, "patch vertices"},
    {GL_PIXEL_PACK_BUFFER_BINDING, "pack buffer"},
    {GL_PIXEL_UNPACK_BUFFER_BINDING, "unpack buffer"},
    {GL_POINT_SIZE, "point size"},
    {GL_POLYGON_MODE, "polygon mode"},
    {GL_POLYGON_OFFSET_FACTOR, "polygon offset factor"},
    {GL_POLYGON_OFFSET_UNITS, "polygon offset units"},
    {GL_PRIMITIVE_RESTART_INDEX, "primitive restart index"},
    {GL_PROVOKING_VERTEX, "provoking vertex"},
    {GL_READ_FRAMEBUFFER_BINDING, "read framebuffer"},
    {GL_RENDERBUFFER_BINDING, "renderbuffer"},
    {GL_SAMPLE_COVERAGE_INVERT, "sample coverage invert"},
    {GL_SAMPLE_COVERAGE_VALUE, "sample coverage value"},
    {GL_SHADER_STORAGE_BUFFER_BINDING, "storage buffer"},
    {GL_STENCIL_BACK_FUNC, "stencil back function"},
    {GL_STENCIL_FUNC, "stencil function"},
    {GL_STENCIL_WRITEMASK, "stencil mask"},
    {GL_TEXTURE_BUFFER_BINDING, "texture buffer"},
    {GL_TRANSFORM_FEEDBACK_BINDING, "transform feedback"},
    {GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, "transform feedback buffer"},
    {GL_UNIFORM_BUFFER_BINDING, "uniform buffer"},
    {GL_UNPACK_ALIGNMENT, "unpack alignment"},
    {GL_UNPACK_IMAGE_HEIGHT, "unpack image height"},
    {GL_UNPACK_LSB_FIRST, "unpack lsb first"},
    {GL_UNPACK_ROW_LENGTH, "unpack row length"},
    {GL_UNPACK_SKIP_IMAGES, "unpack skip images"},
    {GL_UNPACK_SKIP_PIXELS, "unpack skip pixels"},
    {GL_UNPACK_SKIP_ROWS, "unpack skip rows"},
    {GL_UNPACK_SWAP_BYTES, "unpack swap bytes"},
    {GL_VERTEX_ARRAY_BINDING, "vertex array"},
};

/// Every value of the state by name.
using Snapshot = std::map<std::string, std::vector<double>>;

Snapshot take_snapshot() {
    Snapshot state;
    for (std::size_t i = 0; i < std::size(switches); ++i) {
        state["switch " + std::to_string(i)] = {static_cast<double>(glIsEnabled(switches[i]))};
    }
    for (const Value& value : values) {
        std::vector<double> numbers(16, 0);
        glGetDoublev(value.name, numbers.data());
        numbers.resize(static_cast<std::size_t>(value.count));
        state[value.text] = numbers;
    }
    const auto indexed = [&](const char* text, GLenum name, GLuint index, int count = 1) {
        std::vector<double> numbers(4, 0);
        glGetDoublei_v(name, index, numbers.data());
        numbers.resize(static_cast<std::size_t>(count));
        state[text + (" " + std::to_string(index))] = numbers;
    };
    const auto indexed_integer = [&](const std::string& text, GLenum name, GLuint index) {
        GLint64 number = 0;
        glGetInteger64i_v(name, index, &number);
        state[text + " " + std::to_string(index)] = {static_cast<double>(number)};
    };
    for (GLuint i = 0; i < viewports; ++i) {
        indexed("viewport", GL_VIEWPORT, i, 4);
        indexed("scissor box", GL_SCISSOR_BOX, i, 4);
        indexed("depth range", GL_DEPTH_RANGE, i, 2);
        state["scissor test " + std::to_string(i)] = {static_cast<double>(glIsEnabledi(GL_SCISSOR_TEST, i))};
    }
    for (GLuint i = 0; i < draw_buffers; ++i) {
        state["blend " + std::to_string(i)] = {static_cast<double>(glIsEnabledi(GL_BLEND, i))};
        for (const int name : {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA,
                               GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA}) {
            indexed_integer("blend " + std::to_string(name), static_cast<GLenum>(name), i);
        }
        GLboolean mask[4] = {};
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, mask);
        state["color mask " + std::to_string(i)] = {static_cast<double>(mask[0]), static_cast<double>(mask[1]),
                                                    static_cast<double>(mask[2]), static_cast<double>(mask[3])};
    }
    for (GLuint i = 0; i < block_bindings; ++i) {
        indexed_integer("uniform block", GL_UNIFORM_BUFFER_BINDING, i);
        indexed_integer("uniform block start", GL_UNIFORM_BUFFER_START, i);
        indexed_integer("uniform block size", GL_UNIFORM_BUFFER_SIZE, i);
        indexed_integer("storage block", GL_SHADER_STORAGE_BUFFER_BINDING, i);
        indexed_integer("storage block start", GL_SHADER_STORAGE_BUFFER_START, i);
        indexed_integer("storage block size", GL_SHADER_STORAGE_BUFFER_SIZE, i);
    }
    indexed_integer("sample mask", GL_SAMPLE_MASK_VALUE, 0);
    for (GLuint i = 0; i < 4; ++i) indexed_integer("feedback buffer", GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, i);
    GLint active_unit = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active_unit);
    for (GLuint unit = 0; unit < units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (const int name : {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_ARRAY,
                               GL_TEXTURE_BINDING_CUBE_MAP, GL_TEXTURE_BINDING_3D, GL_SAMPLER_BINDING}) {
            GLint bound = 0;
            glGetIntegerv(static_cast<GLenum>(name), &bound);
            state["unit " + std::to_string(unit) + " " + std::to_string(name)] = {static_cast<double>(bound)};
        }
    }
    glActiveTexture(static_cast<GLenum>(active_unit));
    return state;
}

/// A host that leaves everything in an odd state.
struct WildHost {
    gl::Buffer block = gl::make_buffer(4096, nullptr), other = gl::make_buffer(4096, nullptr);
    gl::Texture plain = gl::make_texture(GL_TEXTURE_2D), cube = gl::make_texture(GL_TEXTURE_CUBE_MAP),
                target = gl::make_texture(GL_TEXTURE_2D), layers = gl::make_texture(GL_TEXTURE_2D_ARRAY),
                multisampled = gl::make_texture(GL_TEXTURE_2D_MULTISAMPLE);
    gl::Sampler sampler = gl::make_sampler();
    gl::VertexArray vertex_array = gl::make_vertex_array();
    gl::Framebuffer draw_framebuffer = gl::make_framebuffer(), read_framebuffer = gl::make_framebuffer();
    gl::TransformFeedback feedback = gl::make_transform_feedback();
    GLuint program = 0;

    WildHost() {
        const char* text = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
        program = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &text);
        glTextureStorage2D(plain.name(), 1, GL_RGBA8, 4, 4);
        glTextureStorage2D(cube.name(), 1, GL_RGBA8, 4, 4);
        glTextureStorage3D(layers.name(), 1, GL_RGBA8, 4, 4, 2);
        glTextureStorage2DMultisample(multisampled.name(), 4, GL_RGBA8, 4, 4, GL_TRUE);
        glTextureStorage2D(target.name(), 1, GL_RGBA8, 4, 4);
        glNamedFramebufferTexture(draw_framebuffer.name(), GL_COLOR_ATTACHMENT0, target.name(), 0);
        glTransformFeedbackBufferBase(feedback.name(), 1, other.name());

        for (const GLenum name : switches) {
            // Flipped, each of them: what is on by default (dithering, multisampling) goes off.
            if (glIsEnabled(name) == GL_TRUE) {
                glDisable(name);
            } else {
                glEnable(name);
            }
        }
        for (GLuint i = 0; i < viewports; ++i) {
            const auto f = static_cast<float>(i);
            glViewportIndexedf(i, 3 + f, 5, 7.5F, 9 + f);
            glScissorIndexed(i, 1, static_cast<GLint>(i), 1, 1);
            glDepthRangeIndexed(i, 0.9 - 0.01 * i, 0.1);
            if (i != 3) glEnablei(GL_SCISSOR_TEST, i);
        }
        for (GLuint i = 0; i < draw_buffers; ++i) {
            if (i % 3 != 2) glEnablei(GL_BLEND, i);
            glBlendFuncSeparatei(i, i % 2 == 0 ? GL_ZERO : GL_DST_COLOR, GL_SRC_COLOR, GL_CONSTANT_ALPHA, GL_DST_ALPHA);
            glBlendEquationSeparatei(i, GL_FUNC_REVERSE_SUBTRACT, i % 2 == 0 ? GL_MIN : GL_MAX);
            glColorMaski(i, i % 2 == 0, GL_FALSE, GL_TRUE, GL_FALSE);
        }
        glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glPolygonOffset(7, 9);
        glCullFace(GL_FRONT_AND_BACK);
        glFrontFace(GL_CW);
        glDepthFunc(GL_NEVER);
        glDepthMask(GL_FALSE);
        glClearDepth(0.25);
        glClearColor(1, 0, 1, 0);
        glStencilFunc(GL_NEVER, 1, 3);
        glStencilMask(2);
        glLogicOp(GL_CLEAR);
        glSampleCoverage(0, GL_TRUE);
        glSampleMaski(0, 0);
        glMinSampleShading(0.75F);
        glPrimitiveRestartIndex(0);
        glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
        glPatchParameteri(GL_PATCH_VERTICES, 5);
        glPointSize(4);
        glClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
        for (const int name : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST}) {
            glPixelStorei(static_cast<GLenum>(name), GL_TRUE);
        }
        for (const int name :
             {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_IMAGE_HEIGHT, GL_UNPACK_ROW_LENGTH,
              GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES}) {
            glPixelStorei(static_cast<GLenum>(name), 3);
        }
        glPixelStorei(GL_PACK_ALIGNMENT, 8);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
        for (const int name : {GL_ARRAY_BUFFER, GL_ATOMIC_COUNTER_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER,
                               GL_DISPATCH_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER,
                               GL_PIXEL_UNPACK_BUFFER, GL_TEXTURE_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER}) {
            glBindBuffer(static_cast<GLenum>(name), other.name());
        }
        for (GLuint i = 0; i < block_bindings; ++i) {
            if (i % 2 == 0) {
                glBindBufferRange(GL_UNIFORM_BUFFER, i, block.name(), 256 * i, 64);
                glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, other.name());
            } else {
                glBindBufferBase(GL_UNIFORM_BUFFER, i, block.name());
                glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, block.name(), 256 * i, 128);
            }
        }
        glBindBuffer(GL_UNIFORM_BUFFER, other.name());
        glBindBuffer(GL_SHADER_STORAGE_BUFFER, block.name());
        for (GLuint unit = 0; unit < units; ++unit) {
            glActiveTexture(GL_TEXTURE0 + unit);
            glBindTexture(GL_TEXTURE_2D, plain.name());
            glBindTexture(GL_TEXTURE_CUBE_MAP, cube.name());
            glBindTexture(GL_TEXTURE_2D_ARRAY, layers.name());
            glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, multisampled.name());
            glBindSampler(unit, sampler.name());
        }
        glActiveTexture(GL_TEXTURE0 + 13);
        glUseProgram(program);
        glBindVertexArray(vertex_array.name());
        glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback.name());
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, draw_framebuffer.name());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, read_framebuffer.name());
    }
    ~WildHost() {
        glUseProgram(0);
        glDeleteProgram(program);
    }
    WildHost(const WildHost&) = delete;
    WildHost& operator=(const WildHost&) = delete;
};

class HostState : public test::GlTest {
protected:
    static void expect_same(const Snapshot& before, const Snapshot& after, const char* what) {
        for (const auto& [name, value] : before) EXPECT_EQ(after.at(name), value) << what << " changed: " << name;
    }
    /// Every pass that there is: targets, turned normals, joints, two materials' worth of blending, tone or copy.
    static Face busy_face() {
        Face face = test::make_face({.targets = 3, .two_primitives = true, .normal_map = true, .joints = true});
        face.materials.push_back(face.materials[0]);
        face.materials[1].alpha_mode = AlphaMode::blend;
        face.materials[1].base_color_linear.a = 0.6F;
        face.materials[1].double_sided = true;
        face.primitives[1].material = 1;
        return face;
    }
};

TEST_F(HostState, TheWildHostIsWild) {
    const Snapshot clean = take_snapshot();
    const WildHost host;
    const Snapshot wild = take_snapshot();
    std::size_t same = 0;
    for (const auto& [name, value] : clean) same += wild.at(name) == value ? 1U : 0U;
    EXPECT_GT(clean.size(), 300U);
    // What stays: 2D multisample, 3D and renderbuffer bindings, viewports' like that cannot all differ.
    EXPECT_LT(same, clean.size() / 6);
}

TEST_F(HostState, DrawingRestoresEverythingAndIsNotDisturbed) {
    const Face face = busy_face();
    for (const Output output : {Output::display_srgb, Output::linear_hdr}) {
        const Offscreen offscreen = make_offscreen(48, 48, output);
        Image expected;
        {
            Portrait character = make_character(face);
            test::set_weights(character, {1, 0.5F, 0});
            expected = test::draw(character, offscreen);
            ViewFrame view = test::framed_view(character, offscreen);
            view.background_linear = {1, 0, 0, 1};
            character.draw(view);  // so that what the wild host leaves cannot pass by drawing nothing
        }
        const WildHost host;
        const Snapshot before = take_snapshot();
        Portrait character = make_character(face);
        expect_same(before, take_snapshot(), "Portrait::create");
        test::set_weights(character, {1, 0.5F, 0});
        ViewFrame view = test::framed_view(character, offscreen);
        view.timed = true;
        character.draw(view);
        expect_same(before, take_snapshot(), "Scene::draw");
        const Image image = offscreen.read();
        expect_same(before, take_snapshot(), "Offscreen::read");
        EXPECT_EQ(image.bytes, expected.bytes);
        EXPECT_EQ(image.floats, expected.floats);

        ASSERT_TRUE(character.set("deformation.method", "passes"));
        const Image in_passes = test::draw(character, offscreen);
        EXPECT_EQ(in_passes.bytes, expected.bytes);
        EXPECT_EQ(in_passes.floats, expected.floats);
        expect_same(before, take_snapshot(), "Scene::draw in passes");
        const Scene::Surface surface = character.read_deformed();
        EXPECT_NE(surface.positions, face.positions);
        expect_same(before, take_snapshot(), "Character::read_deformed");
        const Offscreen another = make_offscreen(8, 8);
        expect_same(before, take_snapshot(), "Offscreen::create");
    }
}

TEST_F(HostState, MapsOfWrinklesAndBloodRestoreEverythingAndAreNotDisturbed) {
    const std::filesystem::path path = std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb";
    const Offscreen offscreen = make_offscreen(24, 24);
    const auto angry = [&] {
        // Loaded anew, so that its maps go to the GPU anew.
        Portrait character = *Portrait::create(device_, *FaceAsset::load(path));
        character.set(*character.control("anger"), 1);
        return character;
    };
    Portrait first = angry();
    const Image expected = test::draw(first, offscreen);
    const WildHost host;
    const Snapshot before = take_snapshot();
    Portrait character = angry();
    const FrameReport& report = character.draw(test::framed_view(character, offscreen));
    expect_same(before, take_snapshot(), "Scene::draw");
    EXPECT_EQ(offscreen.read().bytes, expected.bytes);
    for (const char* effect : {"wrinkles", "blood"}) {
        EXPECT_TRUE(std::ranges::any_of(report.effects, [effect](const EffectReport& each) {
            return each.effect == effect && each.on;
        })) << effect;
    }
}

TEST_F(HostState, EveryWayToSampleRestoresEverythingAndIsNotDisturbed) {
    const Offscreen offscreen = make_offscreen(24, 24);
    for (const auto& [mode, resolve] : {std::pair("msaa4", "hdr"), {"smaa_4x", "average"}}) {
        SCOPED_TRACE(mode);
        const auto two_frames = [&, mode = mode, resolve = resolve](const std::function<void(const char*)>& check) {
            Portrait character = make_character(busy_face());
            EXPECT_TRUE(character.set("antialiasing.mode", mode));
            EXPECT_TRUE(character.set("multisampling.resolve", resolve));
            ViewFrame view = test::framed_view(character, offscreen);
            view.check_finite = false;
            character.draw(view);
            check("the first frame");
            test::set_weights(character, {1, 0.5F, 0});
            character.draw(view);
            check("the second frame");
            return offscreen.read();
        };
        const Image expected = two_frames([](const char*) {});
        const WildHost host;
        const Snapshot before = take_snapshot();
        const Image image = two_frames([&](const char* what) { expect_same(before, take_snapshot(), what); });
        EXPECT_EQ(image.bytes, expected.bytes);
    }
}

}  // namespace
}  // namespace blush
