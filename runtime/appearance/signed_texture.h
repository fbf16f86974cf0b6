#pragma once
/// Textures of small signed numbers: partial derivatives, differences of normals.

#include <cstddef>

#include "rig/face.h"
#include "rig/wrinkles/derivative_map.h"
#include "runtime/gl/object.h"

namespace blush {

/// The first `channels` (2 or 3) of a map within -1..1, repeated, with its mip levels: without them folds flicker once
/// they are narrower than a pixel. The levels are averaged here, since GL does not make those of compressed textures.
/// format: GL_COMPRESSED_SIGNED_RG_RGTC2, GL_RG8_SNORM, GL_RGB8_SNORM, GL_RG16F or GL_RGB16F. Compression is the
/// driver's own.
gl::Texture make_signed_texture(GLenum format, Map<glm::vec3> map, std::size_t channels);

/// A base normal map as partial derivatives (jimenez-2012, 8.2; 8.3 has it at full resolution in 3Dc, which GL calls
/// RGTC2). Texels within half a step of flat are flat to the bit.
struct BaseNormalTexture {
    gl::Texture texture;
    float range = 1;  ///< derivative that its 1 stands for
};
/// `format`: of two channels; 0: RGTC2 for an image of bytes, half floats for one of floats.
BaseNormalTexture make_base_normal_texture(const Image& image, GLenum format = 0);

/// Angle in degrees between what make_base_normal_texture() stores and the vectors of the image, texel by texel.
struct BaseNormalError {
    double mean = 0, worst = 0;
};
BaseNormalError base_normal_error(const Image& image, GLenum format = 0);

/// The vectors of an ordinary normal map, of any length; an image without three channels gives flat ones.
NormalMap normals_of(const Image& image);

/// A base map keeps what is flatter than this for all but a thousandth of its texels: at least
/// published_derivative_range, so that ordinary maps have all of their precision, and at most 4 (76 degrees).
float base_normal_range(const NormalMap& normals);

}  // namespace blush
