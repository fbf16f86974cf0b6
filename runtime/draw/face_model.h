#pragma once
/// FaceModel: what drawing a face needs beside its deformed surface: indices, texture coordinates, materials, textures.

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/result.h"
#include "runtime/deform/stream_out.h"
#include "runtime/face_asset.h"
#include "runtime/frame/store.h"
#include "runtime/gl/object.h"

namespace blush {

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
    /// Binds the block of a material (-1: the default one), and those of its textures that the program reads
    /// (material_textures(), or some of them) to units from 0 on.
    void bind_maps(std::int32_t material, std::uint32_t textures) const;

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

/// Bit t: the material (-1: the default one) has the t-th texture, in the order of MaterialBlock.
std::uint32_t material_textures(const Face& face, std::int32_t material);
/// The first of them.
inline constexpr std::uint32_t base_color_texture = 1;
/// What shaders/draw/material.glsl asks: "BASE_COLOR_MAP 0", the unit of each texture.
void material_defines(std::uint32_t textures, std::vector<std::string>& out);

}  // namespace blush
