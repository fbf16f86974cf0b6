#include "runtime/gl/texture_pool.h"

#include <algorithm>

namespace blush::gl {

GLenum internal_format(PixelFormat format) {
    switch (format) {
        case PixelFormat::r8:
            return GL_R8;
        case PixelFormat::rg8:
            return GL_RG8;
        case PixelFormat::rgba8:
            return GL_RGBA8;
        case PixelFormat::r16f:
            return GL_R16F;
        case PixelFormat::rg16f:
            return GL_RG16F;
        case PixelFormat::rgba16f:
            return GL_RGBA16F;
        case PixelFormat::r32f:
            return GL_R32F;
        case PixelFormat::rg32f:
            return GL_RG32F;
        case PixelFormat::rgba32f:
            return GL_RGBA32F;
        case PixelFormat::depth32f:
            return GL_DEPTH_COMPONENT32F;
        case PixelFormat::depth32f_stencil8:
            return GL_DEPTH32F_STENCIL8;
        case PixelFormat::stencil8:
            return GL_STENCIL_INDEX8;
    }
    return GL_NONE;
}

bool has_depth(PixelFormat format) {
    return format == PixelFormat::depth32f || format == PixelFormat::depth32f_stencil8;
}

bool is_half_float(PixelFormat format) {
    return format == PixelFormat::r16f || format == PixelFormat::rg16f || format == PixelFormat::rgba16f;
}

std::uint32_t TexturePool::acquire(const TextureShape& shape) {
    for (Kept& kept : kept_) {
        if (!kept.in_use && kept.shape == shape) {
            kept.in_use = true;
            kept.frames_unused = 0;
            return kept.texture.name();
        }
    }
    // A shape that was asked for and is not there: the view changed. Textures of shapes no longer asked for go once
    // this many others have been made since.
    constexpr int patience = 16;
    for (Kept& kept : kept_) ++kept.frames_unused;
    std::erase_if(kept_, [](const Kept& kept) { return !kept.in_use && kept.frames_unused > patience; });

    const bool multisampled = shape.samples > 1;
    Texture texture = make_texture(multisampled ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
    const auto width = static_cast<GLsizei>(shape.width), height = static_cast<GLsizei>(shape.height);
    if (multisampled) {
        glTextureStorage2DMultisample(texture.name(), static_cast<GLsizei>(shape.samples),
                                      internal_format(shape.format), width, height, GL_TRUE);
    } else {
        glTextureStorage2D(texture.name(), 1, internal_format(shape.format), width, height);
        glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    kept_.push_back({shape, std::move(texture), true, 0});
    return kept_.back().texture.name();
}

void TexturePool::release(std::uint32_t handle, const TextureShape& /*shape*/) {
    for (Kept& kept : kept_) {
        if (kept.texture.name() == handle) kept.in_use = false;
    }
}

}  // namespace blush::gl
