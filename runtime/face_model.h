#pragma once
/// FaceModel: what drawing a face needs beside its deformed surface: indices, texture coordinates, materials, textures.

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "rig/face.h"
#include "rig/result.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"
#include "runtime/stream_out.h"

namespace blush {

struct FaceModel {
    static Result<FaceModel> create(const Face& face, int largest_texture_side_texels);

    /// Binds the vertex array with `surface` as its positions, normals and tangents.
    void bind_surface(const SurfaceBuffers& surface) const;
    /// Uses the program, and binds the block and the textures, of a material (-1: the default one).
    void bind_material(const Face& face, std::int32_t material) const;
    /// Binds entry `index` of draw_blocks.
    void bind_draw(std::size_t index) const;

    gl::VertexArray vertex_array;
    gl::Buffer indices, uv0, uv1;

    gl::Buffer frame_block;
    gl::Buffer draw_blocks;  ///< shared::DrawBlock of each node and, last, the identity; draw_stride bytes apart
    gl::Buffer
        material_blocks;  ///< shared::MaterialBlock of each material and, last, the default; material_stride apart
    std::size_t draw_stride = 0, material_stride = 0;
    std::vector<std::byte> draw_staging;

    /// By image, read as sRGB and read as it is; made only where a material reads them so.
    std::vector<gl::Texture> srgb_textures, linear_textures;
    /// Permutations of face.frag: bit t is set when the material has texture t, in the order of MaterialBlock.
    std::map<std::uint32_t, gl::Program> programs;
    std::array<gl::Sampler, 4> samplers;  ///< bit 0: repeat u, bit 1: repeat v (else clamp)
};

}  // namespace blush
