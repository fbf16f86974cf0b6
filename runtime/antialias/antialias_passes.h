#pragma once
/// The filters of rig/antialias/ as passes on the GPU. Each function is one pass: it binds what it needs, draws over
/// the whole target and leaves the rest to the caller, so that each can be a pass of a frame graph.
///
/// "Up" is towards row 0 of the textures, whichever way the picture stands in them; offsets of subsamples count rows
/// the same way. Textures may have any size and filter: samplers are the passes' own. The state that passes expect is
/// that of gl::StateGuard; units 0 to 3, the program, the vertex array, the draw framebuffer and the viewport are
/// changed.

#include <array>
#include <cstdint>

#include "rig/antialias/settings.h"
#include "rig/result.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

/// A framebuffer with one colour attachment of this size.
struct PassTarget {
    GLuint framebuffer = 0;
    std::uint32_t width = 0, height = 0;
};

class AntialiasPasses {
public:
    /// Compiles the shaders and uploads the tables. Error: a driver that does not compile them.
    static Result<AntialiasPasses> create();

    /// Edges of `color` into a target of two channels (GL_RG8). depth: a depth or one-channel texture of the same size;
    /// 0 unless the settings ask for one. Both are single-sampled.
    void edges(GLuint color, GLuint depth, const EdgeSettings& settings, const PictureMeaning& meaning,
               const PassTarget& target) const;

    /// Weights of edges into a target of four channels (GL_RGBA8).
    void smaa_weights(GLuint edges, const SmaaSettings& settings, SubsampleSlices slices,
                      const PassTarget& target) const;
    void mlaa_weights(GLuint edges, const MlaaSettings& settings, const PassTarget& target) const;

    /// The picture, smoothed by weights, into a target that `color` is not attached to.
    void blend(GLuint color, GLuint weights, const PictureMeaning& meaning, const PassTarget& target) const;

private:
    AntialiasPasses() = default;
    void draw(const gl::Program& program, const PassTarget& target) const;

    std::array<std::array<gl::Program, 2>, 3> edges_;  // [EdgeSource][predicated]
    std::array<gl::Program, 2> smaa_weights_;          // [with diagonals]
    gl::Program mlaa_weights_;
    std::array<std::array<gl::Program, 2>, 2> blend_;  // [decodes sRGB][straight alpha]
    gl::Texture orthogonal_areas_, diagonal_areas_, search_, mlaa_areas_;
    gl::Sampler nearest_, bilinear_with_border_;
    gl::VertexArray no_attributes_;
};

}  // namespace blush
