#include "runtime/antialias/pictures.h"

#include "runtime/gl/texture_pool.h"

namespace blush {
namespace {

gl::Texture make_store(PixelFormat format, const TextureShape& shape) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, stored_format(format), static_cast<GLsizei>(shape.width),
                       static_cast<GLsizei>(shape.height));
    return texture;
}

}  // namespace

PixelFormat picture_format(Output output) {
    return output == Output::display_srgb ? PixelFormat::rgba8 : PixelFormat::rgba16f;
}

GLenum stored_format(PixelFormat format) {
    return format == PixelFormat::rgba8 ? GL_SRGB8_ALPHA8 : gl::internal_format(format);
}

void begin_pictures(FrameState& frame) {
    Pictures& pictures = frame.own<Pictures>();
    if (frame.sampling.pictures == 1 && pictures.first) pictures = {};
}

ResourceId picture_store(FrameState& frame, const TextureShape& shape, FrameGraph& graph) {
    Pictures& pictures = frame.own<Pictures>();
    if (!pictures.first || pictures.shape != shape) {
        pictures = {};
        pictures.shape = shape;
        pictures.first = make_store(shape.format, shape);
    }
    if (frame.picture == 0) return graph.import_texture("first picture", pictures.first.name(), shape);
    // Whatever the number of pictures, 32 bits keep the mean's error below that of the 8 bits shown.
    TextureShape sum_shape = shape;
    sum_shape.format = PixelFormat::rgba32f;
    gl::Texture& sum = pictures.sum[frame.picture % 2];
    if (!sum) sum = make_store(sum_shape.format, sum_shape);
    return graph.import_texture("mean of pictures", sum.name(), sum_shape);
}

ResourceId first_speeds_store(FrameState& frame, TextureShape shape, FrameGraph& graph) {
    Pictures& pictures = frame.own<Pictures>();
    shape.format = PixelFormat::r16f;
    if (!pictures.first_speeds) pictures.first_speeds = make_store(shape.format, shape);
    return graph.import_texture("first speeds", pictures.first_speeds.name(), shape);
}

GLuint pictures_so_far(FrameState& frame) {
    const Pictures& pictures = frame.own<Pictures>();
    return frame.picture == 1 ? pictures.first.name() : pictures.sum[(frame.picture - 1) % 2].name();
}

}  // namespace blush
