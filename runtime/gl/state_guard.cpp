#include "runtime/gl/state_guard.h"

namespace blush::gl {
namespace {

/// All that says how pixels lie in memory (GL 4.5, tables 8.1 and 18.1), the alignment first; layers of array textures
/// have a height and a number to skip of their own.
constexpr std::array<GLenum, 8> pack_names = {GL_PACK_ALIGNMENT,    GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                              GL_PACK_SKIP_PIXELS,  GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST,
                                              GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES};
constexpr std::array<GLenum, 8> unpack_names = {GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                                GL_UNPACK_SKIP_PIXELS,  GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,
                                                GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES};
constexpr std::array<GLenum, 6> blend_names = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                               GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

void set_indexed(GLenum name, GLuint index, GLboolean on) {
    if (on != GL_FALSE) {
        glEnablei(name, index);
    } else {
        glDisablei(name, index);
    }
}

void set(GLenum name, GLboolean on) {
    if (on != GL_FALSE) {
        glEnable(name);
    } else {
        glDisable(name);
    }
}

GLuint name_of(GLint value) { return static_cast<GLuint>(value); }
GLenum enum_of(GLint value) { return static_cast<GLenum>(value); }

}  // namespace

StateGuard::Binding StateGuard::indexed_binding(GLenum binding, GLenum start, GLenum size, GLuint index) {
    Binding found;
    glGetIntegeri_v(binding, index, &found.name);
    glGetInteger64i_v(start, index, &found.offset);
    glGetInteger64i_v(size, index, &found.bytes);
    return found;
}

void StateGuard::restore(GLenum target, GLuint index, const Binding& binding) {
    if (binding.bytes == 0) {
        glBindBufferBase(target, index, name_of(binding.name));
    } else {
        glBindBufferRange(target, index, name_of(binding.name), static_cast<GLintptr>(binding.offset),
                          static_cast<GLsizeiptr>(binding.bytes));
    }
}

StateGuard::StateGuard() {
    for (std::size_t i = 0; i < switches.size(); ++i) enabled_[i] = glIsEnabled(switches[i]);
    active_unit_ = integer(GL_ACTIVE_TEXTURE);
    for (GLuint unit = 0; unit < texture_units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        textures_[unit] = integer(GL_TEXTURE_BINDING_2D);
        multisampled_textures_[unit] = integer(GL_TEXTURE_BINDING_2D_MULTISAMPLE);
        array_textures_[unit] = integer(GL_TEXTURE_BINDING_2D_ARRAY);
        samplers_[unit] = integer(GL_SAMPLER_BINDING);
    }
    glActiveTexture(enum_of(active_unit_));
    for (GLuint i = 0; i < uniform_bindings; ++i) {
        uniform_blocks_[i] =
            indexed_binding(GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, i);
    }
    for (GLuint i = 0; i < storage_bindings; ++i) {
        storage_blocks_[i] = indexed_binding(GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                                             GL_SHADER_STORAGE_BUFFER_SIZE, i);
    }
    uniform_buffer_ = integer(GL_UNIFORM_BUFFER_BINDING);
    storage_buffer_ = integer(GL_SHADER_STORAGE_BUFFER_BINDING);
    pack_buffer_ = integer(GL_PIXEL_PACK_BUFFER_BINDING);
    unpack_buffer_ = integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
    program_ = integer(GL_CURRENT_PROGRAM);
    vertex_array_ = integer(GL_VERTEX_ARRAY_BINDING);
    draw_framebuffer_ = integer(GL_DRAW_FRAMEBUFFER_BINDING);
    read_framebuffer_ = integer(GL_READ_FRAMEBUFFER_BINDING);
    feedback_ = integer(GL_TRANSFORM_FEEDBACK_BINDING);
    for (GLuint i = 0; i < viewports; ++i) {
        glGetFloati_v(GL_VIEWPORT, i, viewports_[i].box.data());
        glGetDoublei_v(GL_DEPTH_RANGE, i, viewports_[i].depth_range.data());
        viewports_[i].scissored = glIsEnabledi(GL_SCISSOR_TEST, i);
    }
    for (GLuint i = 0; i < draw_buffers; ++i) {
        DrawBuffer& buffer = draw_buffers_[i];
        buffer.blended = glIsEnabledi(GL_BLEND, i);
        for (std::size_t k = 0; k < blend_names.size(); ++k) glGetIntegeri_v(blend_names[k], i, &buffer.blend[k]);
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, buffer.color_mask.data());
    }
    for (std::size_t i = 0; i < pack_names.size(); ++i) {
        pack_[i] = integer(pack_names[i]);
        unpack_[i] = integer(unpack_names[i]);
    }
    clip_control_ = {integer(GL_CLIP_ORIGIN), integer(GL_CLIP_DEPTH_MODE)};
    glGetIntegerv(GL_POLYGON_MODE, polygon_mode_.data());
    depth_function_ = integer(GL_DEPTH_FUNC);
    cull_face_ = integer(GL_CULL_FACE_MODE);
    front_face_ = integer(GL_FRONT_FACE);
    clamp_read_ = integer(GL_CLAMP_READ_COLOR);
    provoking_vertex_ = integer(GL_PROVOKING_VERTEX);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    stencil_front_ = {integer(GL_STENCIL_FUNC),
                      integer(GL_STENCIL_REF),
                      integer(GL_STENCIL_VALUE_MASK),
                      integer(GL_STENCIL_FAIL),
                      integer(GL_STENCIL_PASS_DEPTH_FAIL),
                      integer(GL_STENCIL_PASS_DEPTH_PASS),
                      integer(GL_STENCIL_WRITEMASK)};
    stencil_back_ = {integer(GL_STENCIL_BACK_FUNC),
                     integer(GL_STENCIL_BACK_REF),
                     integer(GL_STENCIL_BACK_VALUE_MASK),
                     integer(GL_STENCIL_BACK_FAIL),
                     integer(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
                     integer(GL_STENCIL_BACK_PASS_DEPTH_PASS),
                     integer(GL_STENCIL_BACK_WRITEMASK)};
    glGetFloatv(GL_BLEND_COLOR, blend_color_.data());

    // The state that every pass starts from.
    for (const GLenum name : switches) glDisable(name);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_MULTISAMPLE);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (std::size_t i = 0; i < pack_names.size(); ++i) {
        glPixelStorei(pack_names[i], i == 0 ? 1 : 0);
        glPixelStorei(unpack_names[i], i == 0 ? 1 : 0);
    }
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthFunc(GL_LESS);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glStencilMask(~0U);
    glDepthRange(0, 1);
    glClampColor(GL_CLAMP_READ_COLOR, GL_FALSE);
    // Also the vertex that llvmpipe interpolates from, and so how the last bit rounds.
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    for (GLuint unit = 0; unit < texture_units; ++unit) glBindSampler(unit, 0);
}

StateGuard::~StateGuard() {
    for (std::size_t i = 0; i < switches.size(); ++i) set(switches[i], enabled_[i]);
    for (GLuint unit = 0; unit < texture_units; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);  // glBindTextureUnit with 0 would clear the unit's other targets too
        glBindTexture(GL_TEXTURE_2D, name_of(textures_[unit]));
        glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, name_of(multisampled_textures_[unit]));
        glBindTexture(GL_TEXTURE_2D_ARRAY, name_of(array_textures_[unit]));
        glBindSampler(unit, name_of(samplers_[unit]));
    }
    glActiveTexture(enum_of(active_unit_));
    for (GLuint i = 0; i < uniform_bindings; ++i) restore(GL_UNIFORM_BUFFER, i, uniform_blocks_[i]);
    for (GLuint i = 0; i < storage_bindings; ++i) restore(GL_SHADER_STORAGE_BUFFER, i, storage_blocks_[i]);
    glBindBuffer(GL_UNIFORM_BUFFER, name_of(uniform_buffer_));
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, name_of(storage_buffer_));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, name_of(pack_buffer_));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, name_of(unpack_buffer_));
    glUseProgram(name_of(program_));
    glBindVertexArray(name_of(vertex_array_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_of(draw_framebuffer_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, name_of(read_framebuffer_));
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, name_of(feedback_));
    for (GLuint i = 0; i < viewports; ++i) {
        glViewportIndexedfv(i, viewports_[i].box.data());
        glDepthRangeIndexed(i, viewports_[i].depth_range[0], viewports_[i].depth_range[1]);
        set_indexed(GL_SCISSOR_TEST, i, viewports_[i].scissored);
    }
    for (GLuint i = 0; i < draw_buffers; ++i) {
        const auto& [blended, blend, mask] = draw_buffers_[i];
        set_indexed(GL_BLEND, i, blended);
        glBlendFuncSeparatei(i, enum_of(blend[0]), enum_of(blend[1]), enum_of(blend[2]), enum_of(blend[3]));
        glBlendEquationSeparatei(i, enum_of(blend[4]), enum_of(blend[5]));
        glColorMaski(i, mask[0], mask[1], mask[2], mask[3]);
    }
    for (std::size_t i = 0; i < pack_names.size(); ++i) {
        glPixelStorei(pack_names[i], pack_[i]);
        glPixelStorei(unpack_names[i], unpack_[i]);
    }
    glClipControl(enum_of(clip_control_[0]), enum_of(clip_control_[1]));
    glPolygonMode(GL_FRONT_AND_BACK, enum_of(polygon_mode_[0]));
    glDepthFunc(enum_of(depth_function_));
    glCullFace(enum_of(cull_face_));
    glFrontFace(enum_of(front_face_));
    glDepthMask(depth_mask_);
    const auto restore_stencil = [](GLenum face, const Stencil& stencil) {
        glStencilFuncSeparate(face, enum_of(stencil.function), stencil.reference, name_of(stencil.value_mask));
        glStencilOpSeparate(face, enum_of(stencil.fail), enum_of(stencil.depth_fail), enum_of(stencil.pass));
        glStencilMaskSeparate(face, name_of(stencil.write_mask));
    };
    restore_stencil(GL_FRONT, stencil_front_);
    restore_stencil(GL_BACK, stencil_back_);
    glBlendColor(blend_color_[0], blend_color_[1], blend_color_[2], blend_color_[3]);
    glClampColor(GL_CLAMP_READ_COLOR, enum_of(clamp_read_));
    glProvokingVertex(enum_of(provoking_vertex_));
}

}  // namespace blush::gl
