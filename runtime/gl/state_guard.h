#pragma once
/// Saves the GL state that the library touches, sets a known state, and restores the host's at the end of its scope.

#include <epoxy/gl.h>

#include <array>
#include <optional>

namespace blush::gl {

class StateGuard {
public:
    StateGuard();
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

    static constexpr std::size_t texture_units = 24, uniform_bindings = 4, storage_bindings = 6;
    /// The least that GL 4.5 guarantees (table 23.55 and 23.65), and what Mesa, NVIDIA and AMD have: glViewport and its
    /// kind write them all at once.
    static constexpr std::size_t viewports = 16, draw_buffers = 8;
    /// All are off in every pass but multisampling, and what a pass itself switches on and off.
    static constexpr std::array<GLenum, 30> switches = {GL_CULL_FACE,           GL_DEPTH_TEST,
                                                        GL_STENCIL_TEST,        GL_RASTERIZER_DISCARD,
                                                        GL_MULTISAMPLE,         GL_FRAMEBUFFER_SRGB,
                                                        GL_PRIMITIVE_RESTART,   GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                                        GL_DEPTH_CLAMP,         GL_DITHER,
                                                        GL_COLOR_LOGIC_OP,      GL_LINE_SMOOTH,
                                                        GL_POLYGON_SMOOTH,      GL_POLYGON_OFFSET_FILL,
                                                        GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT,
                                                        GL_PROGRAM_POINT_SIZE,  GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                        GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE,
                                                        GL_SAMPLE_MASK,         GL_SAMPLE_SHADING,
                                                        GL_CLIP_DISTANCE0,      GL_CLIP_DISTANCE1,
                                                        GL_CLIP_DISTANCE2,      GL_CLIP_DISTANCE3,
                                                        GL_CLIP_DISTANCE4,      GL_CLIP_DISTANCE5,
                                                        GL_CLIP_DISTANCE6,      GL_CLIP_DISTANCE7};

private:
    struct Binding {
        GLint name = 0;
        GLint64 offset = 0, bytes = 0;
    };
    struct Viewport {
        std::array<GLfloat, 4> box{};
        std::array<GLdouble, 2> depth_range{};
        GLboolean scissored = GL_FALSE;
    };
    struct DrawBuffer {
        GLboolean blended = GL_FALSE;
        std::array<GLint, 6> blend{};
        std::array<GLboolean, 4> color_mask{};
    };
    struct Stencil {  // of one face
        GLint function = 0, reference = 0, value_mask = 0, fail = 0, depth_fail = 0, pass = 0, write_mask = 0;
    };
    static Binding indexed_binding(GLenum binding, GLenum start, GLenum size, GLuint index);
    static void restore(GLenum target, GLuint index, const Binding& binding);

    std::array<GLboolean, switches.size()> enabled_{};
    std::array<GLint, texture_units> textures_{}, multisampled_textures_{}, array_textures_{}, samplers_{};
    std::array<Binding, uniform_bindings> uniform_blocks_{};
    std::array<Binding, storage_bindings> storage_blocks_{};
    GLint active_unit_ = 0, program_ = 0, vertex_array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0,
          feedback_ = 0;
    GLint uniform_buffer_ = 0, storage_buffer_ = 0, pack_buffer_ = 0, unpack_buffer_ = 0;
    std::array<Viewport, viewports> viewports_{};
    std::array<DrawBuffer, draw_buffers> draw_buffers_{};
    std::array<GLint, 8> pack_{}, unpack_{};
    std::array<GLint, 2> clip_control_{}, polygon_mode_{};
    GLint depth_function_ = 0, cull_face_ = 0, front_face_ = 0, clamp_read_ = 0, provoking_vertex_ = 0;
    Stencil stencil_front_, stencil_back_;
    std::array<GLfloat, 4> blend_color_{};
    GLboolean depth_mask_ = GL_TRUE;
};

/// A guard, where nobody around has one.
class DrawScope {
public:
    explicit DrawScope(bool guards) {
        if (guards) guard_.emplace();
    }

private:
    std::optional<StateGuard> guard_;
};

}  // namespace blush::gl
