#include "runtime/frame/finite_check.h"

#include <cmath>

#include "runtime/gl/texture_pool.h"

namespace blush {
namespace {

bool bad(float value) { return !std::isfinite(value); }

// What exceeds a half float is stored as infinity or as its largest finite value, as the driver likes (GL 4.5, 2.3.4.1:
// llvmpipe clamps), and no pass of ours writes that value on purpose (shaders/draw/face.frag stays below it).
constexpr float largest_half = 65504;
bool bad_half(float value) { return bad(value) || std::abs(value) >= largest_half; }

}  // namespace

std::string NotFinite::sentence() const {
    return "pass \"" + pass + "\" wrote " + std::to_string(value) + " to \"" + resource + "\" at " + place;
}

std::optional<NotFinite> FiniteCheck::scan(const FrameGraph& graph, const FramePass& pass) {
    std::optional<NotFinite> found;
    graph.each_output(pass, [&](const FrameResource& resource) {
        if (found) return;
        if (resource.kind == ResourceKind::float_buffer) found = scan_buffer(resource);
        if (resource.kind == ResourceKind::texture) found = scan_texture(resource);
        // A framebuffer that is presented holds 8-bit values, or a copy of a texture that was scanned.
        if (!found) return;
        found->pass = pass.name;
        found->resource = resource.name;
    });
    return found;
}

std::optional<NotFinite> FiniteCheck::scan_buffer(const FrameResource& resource) {
    values_.resize(std::size_t{resource.count} * resource.components);
    glGetNamedBufferSubData(resource.handle, 0, static_cast<GLsizeiptr>(values_.size() * sizeof(float)),
                            values_.data());
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (!bad(values_[i])) continue;
        return NotFinite{{},
                         {},
                         "vertex " + std::to_string(i / resource.components) + " component " +
                             std::to_string(i % resource.components),
                         values_[i]};
    }
    return std::nullopt;
}

std::optional<NotFinite> FiniteCheck::scan_texture(const FrameResource& resource) {
    const TextureShape& shape = resource.shape;
    if (shape.format == PixelFormat::stencil8) return std::nullopt;  // whole numbers
    const bool depth = gl::has_depth(shape.format);
    const auto width = static_cast<GLint>(shape.width), height = static_cast<GLint>(shape.height);
    if (!read_framebuffer_) {
        read_framebuffer_ = gl::make_framebuffer();
        resolve_framebuffer_ = gl::make_framebuffer();
    }
    const bool stencil = shape.format == PixelFormat::depth32f_stencil8;
    const GLenum depth_attachment = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    const GLenum attachment = depth ? depth_attachment : GL_COLOR_ATTACHMENT0;
    glNamedFramebufferTexture(read_framebuffer_.name(), GL_COLOR_ATTACHMENT0, 0, 0);
    glNamedFramebufferTexture(read_framebuffer_.name(), GL_DEPTH_STENCIL_ATTACHMENT, 0, 0);
    glNamedFramebufferTexture(read_framebuffer_.name(), attachment, resource.handle, 0);
    GLuint from = read_framebuffer_.name();
    if (shape.samples > 1) {
        // Depth cannot be averaged, and a fragment's depth is clamped to [0, 1] by GL itself.
        if (depth) return std::nullopt;
        // The average of samples with one bad among them is bad.
        TextureShape single = shape;
        single.samples = 1;
        if (!resolved_ || resolved_shape_ != single) {
            resolved_ = gl::make_texture(GL_TEXTURE_2D);
            glTextureStorage2D(resolved_.name(), 1, gl::internal_format(shape.format), width, height);
            resolved_shape_ = single;
            glNamedFramebufferTexture(resolve_framebuffer_.name(), GL_COLOR_ATTACHMENT0, resolved_.name(), 0);
        }
        glBlitNamedFramebuffer(from, resolve_framebuffer_.name(), 0, 0, width, height, 0, 0, width, height,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
        from = resolve_framebuffer_.name();
    }
    const std::size_t channels = depth ? 1 : 4;
    values_.resize(std::size_t{shape.width} * shape.height * channels);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    if (!depth) glReadBuffer(GL_COLOR_ATTACHMENT0);
    glReadPixels(0, 0, width, height, depth ? GL_DEPTH_COMPONENT : GL_RGBA, GL_FLOAT, values_.data());
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (gl::is_half_float(shape.format) ? !bad_half(values_[i]) : !bad(values_[i])) continue;
        const std::size_t pixel = i / channels;
        // GL counts rows from the bottom; a picture's reader counts from the top.
        return NotFinite{{},
                         {},
                         "pixel (" + std::to_string(pixel % shape.width) + ", " +
                             std::to_string(shape.height - 1 - pixel / shape.width) + ") channel " +
                             std::to_string(i % channels),
                         values_[i]};
    }
    return std::nullopt;
}

}  // namespace blush
