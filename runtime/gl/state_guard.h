#pragma once
/// Saves the GL state that the library touches, sets a known state, and restores the host's at the end of its scope.

#include <epoxy/gl.h>

#include <array>

namespace blush::gl {

class StateGuard {
public:
    StateGuard();
    ~StateGuard();
    StateGuard(const StateGuard&) = delete;
    StateGuard& operator=(const StateGuard&) = delete;

    static constexpr std::size_t texture_units = 5, uniform_bindings = 3, storage_bindings = 6;
    static constexpr std::array<GLenum, 14> switches = {
        GL_BLEND,           GL_CULL_FACE,   GL_DEPTH_TEST,        GL_STENCIL_TEST,      GL_SCISSOR_TEST,
        GL_RASTERIZER_DISCARD, GL_MULTISAMPLE, GL_FRAMEBUFFER_SRGB, GL_PRIMITIVE_RESTART, GL_DEPTH_CLAMP,
        GL_COLOR_LOGIC_OP,  GL_SAMPLE_ALPHA_TO_COVERAGE, GL_POLYGON_OFFSET_FILL, GL_SAMPLE_MASK};

private:
    struct Binding {
        GLint name = 0;
        GLint64 offset = 0, bytes = 0;
    };
    static Binding indexed_binding(GLenum binding, GLenum start, GLenum size, GLuint index);
    static void restore(GLenum target, GLuint index, const Binding& binding);

    std::array<GLboolean, switches.size()> enabled_{};
    std::array<GLint, texture_units> textures_{}, samplers_{};
    std::array<Binding, uniform_bindings> uniform_blocks_{};
    std::array<Binding, storage_bindings> storage_blocks_{};
    GLint active_unit_ = 0, program_ = 0, vertex_array_ = 0, draw_framebuffer_ = 0, read_framebuffer_ = 0, feedback_ = 0;
    GLint uniform_buffer_ = 0, storage_buffer_ = 0, pack_buffer_ = 0, unpack_buffer_ = 0;
    std::array<GLint, 4> viewport_{}, pack_{}, unpack_{};
    std::array<GLint, 2> clip_control_{}, polygon_mode_{};
    GLint depth_function_ = 0, cull_face_ = 0, front_face_ = 0;
    std::array<GLint, 6> blend_{};
    std::array<GLboolean, 4> color_mask_{};
    GLboolean depth_mask_ = GL_TRUE;
    std::array<GLdouble, 2> depth_range_{};
};

}  // namespace blush::gl
