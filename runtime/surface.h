#pragma once
/// The deformed surface as it lies on the GPU, for hosts that draw it themselves.

#include <cstdint>
#include <span>

#include "rig/vectors.h"

namespace blush {

/// One attribute of every vertex, tightly packed 32-bit floats in a GL buffer.
struct VertexBuffer {
    std::uint32_t name = 0;          ///< GL name; 0: nothing was deformed yet
    std::uint32_t components = 0;    ///< floats a vertex: 2, 3 or 4
    std::uint32_t stride_bytes = 0;  ///< from one vertex to the next
    std::uint32_t count = 0;         ///< vertices
};

/// A run of triangles of one material, as one node draws it.
struct SurfacePrimitive {
    std::uint32_t first_index = 0, index_count = 0;    ///< into the index buffer
    std::uint32_t first_vertex = 0, vertex_count = 0;  ///< that its indices name
    std::int32_t material = -1;                        ///< of Face::materials; -1: the default one
    std::uint32_t node = 0;                            ///< of Face::nodes
    DMat4 world_from_mesh{1};                          ///< takes the buffers' positions to the world
    bool mirrored = false;                             ///< by world_from_mesh: front faces are clockwise
};

/// What the last draw or deformation of a character's scene left of it. Names, contents and matrices stand until the
/// next one, or until the character goes; the names may be others then. Read only: other characters and later frames
/// share them. Positions, normals and tangents are final: after targets, joints and pins.
struct PublishedSurface {
    VertexBuffer positions;     ///< 3 floats
    VertexBuffer normals;       ///< 3 floats, unit length
    VertexBuffer tangents;      ///< 4 floats: bitangent = cross(normal, xyz) * w
    VertexBuffer uv0, uv1;      ///< 2 floats
    std::uint32_t indices = 0;  ///< GL name: 32 bits an index, triangles, counter-clockwise from the front
    std::uint32_t index_count = 0;
    std::span<const SurfacePrimitive> primitives;  ///< all that nodes draw, in their order
};

}  // namespace blush
