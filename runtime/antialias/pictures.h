#pragma once
/// Where the pictures of one frame wait for one another. A frame of one picture keeps nothing here.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Of a finished picture: 8-bit sRGB, or half-float radiance.
PixelFormat picture_format(Output output);

/// Of a picture that is kept to be averaged: display values are decoded where they are fetched, by the texture unit.
/// (They are written as they are, since GL_FRAMEBUFFER_SRGB is off.)
GLenum stored_format(PixelFormat format);

struct Pictures {
    gl::Texture first;               ///< as the filter left it
    gl::Texture first_speeds;        ///< r16f: of a temporal mode
    std::array<gl::Texture, 2> sum;  ///< rgba32f, linear: mean of the first pictures; in turn, where more than two
    TextureShape shape;              ///< of first
};

/// Forgets what a frame of one picture does not need.
void begin_pictures(FrameState& frame);

/// What the picture being drawn (not the last one) goes to.
ResourceId picture_store(FrameState& frame, const TextureShape& shape, FrameGraph& graph);

/// What the speeds of the first of two pictures go to. After picture_store().
ResourceId first_speeds_store(FrameState& frame, TextureShape shape, FrameGraph& graph);

/// GL name of the mean of the pictures before the one being drawn (not the first one).
GLuint pictures_so_far(FrameState& frame);

}  // namespace blush
