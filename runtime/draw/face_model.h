#pragma once
/// FaceModel: what drawing a face needs beside its deformed surface: indices, texture coordinates, materials, textures.

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "rig/face.h"
#include "rig/head/material_kind.h"
#include "rig/result.h"
#include "runtime/deform/stream_out.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

/// Bits of a permutation of face.frag: the material's first five textures come first, in the order of MaterialBlock.
enum ShadeBits : std::uint32_t {
    shade_skin = 1U << 5,  ///< of the material
    shade_scatter = 1U << 6,
    shade_skin_reflection = 1U << 7,
    shade_shadows = 1U << 8,
    shade_translucency = 1U << 9,
    shade_environment = 1U << 10,
    shade_ambient_occlusion = 1U << 11,
    shade_wrinkles = 1U << 12,
    shade_wrinkle_differences = 1U << 13,
    shade_blood = 1U << 14,
    shade_eye = 1U << 15,  ///< of the material, where the frame has it
    shade_mouth = 1U << 16,
    shade_hair = 1U << 17,
    shade_pigment_colour = 1U << 18,  ///< with blood
    shade_specular_map = 1U << 24,    ///< of the material
};

struct FaceModel {
    static Result<FaceModel> create(const Face& face, int largest_texture_side_texels);

    /// Binds the vertex array with `surface` as its positions, normals and tangents.
    void bind_surface(const SurfaceBuffers& surface) const;
    /// Binds the block and the textures of a material (-1: the default one), for a program of the caller's.
    void bind_maps(const Face& face, std::int32_t material) const;
    /// Uses the program, and binds the block and the textures, of a material (-1: the default one). frame_bits: what
    /// the frame adds to the permutation; prepare() must have been called with them.
    void bind_material(const Face& face, std::int32_t material, MaterialKind kind, std::uint32_t frame_bits) const;
    /// Makes the programs that a frame needs, where they are not there yet. kinds: of each material and, last, the
    /// default one.
    Status prepare(const Face& face, const std::vector<MaterialKind>& kinds, std::uint32_t frame_bits);
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

    /// By image, read as sRGB, as it is, and as normals in the form of partial derivatives; made only where a material
    /// reads them so.
    std::vector<gl::Texture> srgb_textures, linear_textures, normal_textures;
    /// Permutations of face.frag, by their ShadeBits.
    std::map<std::uint32_t, gl::Program> programs;
    std::array<gl::Sampler, 4> samplers;  ///< bit 0: repeat u, bit 1: repeat v (else clamp)

private:
    /// Those that the use-th texture of a material is among.
    const std::vector<gl::Texture>& textures_for(std::size_t use) const;
};

}  // namespace blush
