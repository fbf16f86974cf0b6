#pragma once
/// FaceModel: what drawing a face needs beside its deformed surface: indices, texture coordinates, materials, textures.

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "rig/face.h"
#include "rig/head/material_kind.h"
#include "rig/result.h"
#include "runtime/deform/stream_out.h"
#include "runtime/face_asset.h"
#include "runtime/frame/store.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

struct DeviceState;

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

/// Where the nodes of one character stand: shared::DrawBlock of each node and, last, of skinned vertices.
struct DrawBlocks {
    gl::Buffer buffer;
    std::size_t stride = 0;  ///< bytes between entries
    std::vector<std::byte> staging;

    static DrawBlocks create(std::size_t count);
    /// Binds entry `index`.
    void bind(std::size_t index) const;
};

/// Shared by all characters that show one asset on one device.
struct FaceModel {
    static Result<std::shared_ptr<FaceModel>> create(const Device& device, const FaceAsset& asset);

    /// Binds the vertex array with `surface` as its positions, normals and tangents.
    void bind_surface(const SurfaceBuffers& surface) const;
    /// Binds the block and the textures of a material (-1: the default one), for a program of the caller's.
    void bind_maps(const Face& face, std::int32_t material) const;

    Device device;
    FaceAsset asset;
    std::shared_ptr<DeformModel> deform;
    gl::VertexArray vertex_array;
    gl::Buffer indices, uv0, uv1;
    gl::Buffer
        material_blocks;  ///< shared::MaterialBlock of each material and, last, the default; material_stride apart
    std::size_t material_stride = 0;

    /// By image, read as sRGB, as it is, and as normals in the form of partial derivatives; made only where a material
    /// reads them so.
    std::vector<gl::Texture> srgb_textures, linear_textures, normal_textures;
    std::array<gl::Sampler, 4> samplers;  ///< bit 0: repeat u, bit 1: repeat v (else clamp)
    Store store;                          ///< of effects' maps

    template <class T>
    T& own() {
        return store.get<T>();
    }

private:
    FaceModel(Device on, FaceAsset shows) : device(std::move(on)), asset(std::move(shows)) {}
    Status build();
    /// Those that the use-th texture of a material is among.
    const std::vector<gl::Texture>& textures_for(std::size_t use) const;
};

/// Bits of the permutation that shades a material. frame_bits: what the frame adds.
std::uint32_t permutation_of(const Face& face, std::int32_t material, MaterialKind kind, std::uint32_t frame_bits);
/// Permutations that were made on a device.
struct ShadePrograms {
    std::map<std::uint32_t, gl::Program> made;
};
/// The program of a permutation, made where it is not there yet; none where that fails (gl::require_program).
gl::Program shade_program(DeviceState& device, std::uint32_t permutation);

}  // namespace blush
