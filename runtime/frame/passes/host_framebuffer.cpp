/// How a picture and its depth go together with what the host's framebuffer holds.

#include <array>

#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// The host's depth, copied out of its framebuffer.
struct HostDepthCopy {
    gl::Texture texture;
    gl::Framebuffer framebuffer;
    GLenum format = GL_NONE;
    std::uint32_t width = 0, height = 0;
};

/// Format of a framebuffer's depth: a copy needs the same one. GL_NONE: it has no depth.
GLenum depth_format(GLuint framebuffer) {
    const GLenum attachment = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const auto ask = [&](GLenum what) {
        GLint value = 0;
        glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment, what, &value);
        return value;
    };
    const GLint type = ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
    if (type == GL_NONE) return GL_NONE;
    GLint format = GL_NONE;
    if (type == GL_TEXTURE) {
        const auto name = static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
        glGetTextureLevelParameteriv(name, ask(GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL), GL_TEXTURE_INTERNAL_FORMAT,
                                     &format);
        return static_cast<GLenum>(format);
    }
    if (type == GL_RENDERBUFFER) {
        const auto name = static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
        glGetNamedRenderbufferParameteriv(name, GL_RENDERBUFFER_INTERNAL_FORMAT, &format);
        return static_cast<GLenum>(format);
    }
    const GLint bits = ask(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    GLint stencil = GL_NONE;
    glGetNamedFramebufferAttachmentParameteriv(framebuffer, GL_STENCIL, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE,
                                               &stencil);
    if (bits == 32) return stencil == GL_NONE ? GL_DEPTH_COMPONENT32F : GL_DEPTH32F_STENCIL8;
    if (bits == 16) return GL_DEPTH_COMPONENT16;
    return stencil == GL_NONE ? GL_DEPTH_COMPONENT24 : GL_DEPTH24_STENCIL8;
}

GLenum depth_attachment(GLenum format) {
    const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    return stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

/// Copies the view's rectangle of the host's depth. False where there is none.
bool copy_host_depth(const ViewFrame& view, HostDepthCopy& copy) {
    const GLenum format = depth_format(view.framebuffer);
    if (format == GL_NONE) return false;
    if (copy.format != format || copy.width != view.width || copy.height != view.height) {
        copy.texture = gl::make_texture(GL_TEXTURE_2D);
        glTextureStorage2D(copy.texture.name(), 1, format, static_cast<GLsizei>(view.width),
                           static_cast<GLsizei>(view.height));
        glTextureParameteri(copy.texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTextureParameteri(copy.texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        copy.framebuffer = gl::make_framebuffer();
        glNamedFramebufferTexture(copy.framebuffer.name(), depth_attachment(format), copy.texture.name(), 0);
        copy.format = format;
        copy.width = view.width;
        copy.height = view.height;
    }
    const auto x = static_cast<GLint>(view.x), y = static_cast<GLint>(view.y);
    const auto width = static_cast<GLint>(view.width), height = static_cast<GLint>(view.height);
    glBlitNamedFramebuffer(view.framebuffer, copy.framebuffer.name(), x, y, x + width, y + height, 0, 0, width, height,
                           GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    return true;
}

/// The view's rectangle of the host's framebuffer is drawn to, its first colour attachment alone.
void bind_rectangle(FrameState& frame, const FrameGraph& graph, ResourceId target) {
    bind_output(frame, graph, target);
    glViewport(static_cast<GLint>(frame.view->x), static_cast<GLint>(frame.view->y),
               static_cast<GLsizei>(frame.view->width), static_cast<GLsizei>(frame.view->height));
}

void set_corner(const ViewFrame& view) { glUniform2i(0, static_cast<GLint>(view.x), static_cast<GLint>(view.y)); }

void compose(FrameState& frame, const FrameGraph& graph, ResourceId from, ResourceId target) {
    bind_rectangle(frame, graph, target);
    glUseProgram(frame.common->compose.name());
    glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, graph[from].handle);
    glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
    set_corner(*frame.view);
    const bool kept = graph[from].imported;  // runtime/antialias/pictures.h: stored_format()
    glUniform1i(1, kept && frame.view->output == Output::display_srgb ? 1 : 0);
    if (frame.view->backdrop == Backdrop::keep) {
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glBlendEquation(GL_FUNC_ADD);
    }
    draw_screen(frame);
    glDisable(GL_BLEND);
}

void read_depth(FrameState& frame, const FrameGraph& graph, ResourceId to) {
    const ViewFrame& view = *frame.view;
    HostDepthCopy& copy = frame.own<HostDepthCopy>();
    const GLuint framebuffer = frame.common->depth_only.name();
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[to].handle, 0);
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
    if (!copy_host_depth(view, copy)) return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(view.width), static_cast<GLsizei>(view.height));
    glUseProgram(frame.common->move_depth.name());
    glBindTextureUnit(0, copy.texture.name());
    glBindSampler(0, 0);
    glUniform2i(0, 0, 0);
    glUniform1i(1, view.depth_convention.reversed ? 1 : 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    draw_screen(frame);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

void write_depth(FrameState& frame, const FrameGraph& graph, ResourceId target) {
    const ViewFrame& view = *frame.view;
    const FrameResource& depth = graph[frame.resources.scene_depth];
    bind_rectangle(frame, graph, target);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glUseProgram((depth.shape.samples > 1 ? frame.common->move_multisampled_depth : frame.common->move_depth).name());
    glBindTextureUnit(0, depth.handle);
    glBindSampler(0, 0);
    set_corner(view);
    glUniform1i(1, view.depth_convention.reversed ? 1 : 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(view.depth_convention.reversed ? GL_GREATER : GL_LESS);
    draw_screen(frame);
    glDepthFunc(GL_LESS);
    glDisable(GL_DEPTH_TEST);
}

void write_velocities(FrameState& frame, const FrameGraph& graph, ResourceId target) {
    bind_rectangle(frame, graph, target);
    glUseProgram(frame.common->write_velocities.name());
    glBindTextureUnit(0, graph[frame.resources.velocities].handle);
    glBindSampler(0, 0);
    set_corner(*frame.view);
    draw_screen(frame);
}

}  // namespace

bool make_common_passes(FrameState& frame) {
    auto& common = frame.shared_own<CommonPasses>();
    frame.common = &common;
    if (!common.output) {
        common.scene = gl::make_framebuffer();
        common.resolved = gl::make_framebuffer();
        common.output = gl::make_framebuffer();
        common.depth_only = gl::make_framebuffer();
        common.no_attributes = gl::make_vertex_array();
    }
    constexpr std::array<std::string_view, 1> multisampled = {"MULTISAMPLED"};
    return gl::require_program(common.tone, {"screen.vert", "camera/tone.frag"}) &&
           gl::require_program(common.compose, {"screen.vert", "frame/compose.frag"}) &&
           gl::require_program(common.write_velocities, {"screen.vert", "frame/write_velocities.frag"}) &&
           gl::require_program(common.move_depth, {"screen.vert", "frame/move_depth.frag"}) &&
           gl::require_program(common.move_multisampled_depth, {"screen.vert", "frame/move_depth.frag", multisampled});
}

void declare_compose(FrameState& frame, ResourceId from, ResourceId target) {
    const auto pass = [&frame, from, target](const FrameGraph& graph) { compose(frame, graph, from, target); };
    frame.graph.pass("compose", pass).reads(from).modifies(target);
}

void declare_read_depth(FrameState& frame, ResourceId to) {
    frame.graph.pass("read host depth", [&frame, to](const FrameGraph& graph) { read_depth(frame, graph, to); })
        .writes(to);
}

void declare_write_velocities(FrameState& frame) {
    const ViewFrame& view = *frame.view;
    const ResourceId target = frame.graph.import_framebuffer("host velocities", view.velocity_framebuffer,
                                                             {PixelFormat::rg16f, view.width, view.height, 1});
    const auto pass = [&frame, target](const FrameGraph& graph) { write_velocities(frame, graph, target); };
    frame.graph.pass("write velocities", pass).reads(frame.resources.velocities).modifies(target);
    frame.graph.present(target);
}

void declare_write_depth(FrameState& frame, ResourceId target) {
    const auto pass = [&frame, target](const FrameGraph& graph) { write_depth(frame, graph, target); };
    frame.graph.pass("write host depth", pass).reads(frame.resources.scene_depth).modifies(target);
}

}  // namespace blush
