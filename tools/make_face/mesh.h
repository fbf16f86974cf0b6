#pragma once
/// A triangle mesh as the face maker builds it, and its smooth normals.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/make_face/geometry.h"

namespace blush::make_face {

using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

struct Mesh {
    std::vector<Vec3> positions;  ///< millimetres
    std::vector<Vec3> normals;    ///< unit length
    std::vector<Vec2> uv;         ///< v grows downward, as glTF has it
    std::vector<Triangle> triangles;

    Index add(const Vec3& position, const Vec2& texture) {
        positions.push_back(position);
        uv.push_back(texture);
        return static_cast<Index>(positions.size() - 1);
    }
    /// Two triangles of the corners a, b, c, d in counter-clockwise order; a collapsed corner leaves one triangle.
    void add_quad(Index a, Index b, Index c, Index d);
};

/// Angle-weighted vertex normals (Thuermer and Wuthrich 1998). `weld[v]` names the vertex whose normal v shares.
std::vector<Vec3> smooth_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                 std::span<const Index> weld);

/// The same where nothing is welded.
std::vector<Vec3> smooth_normals(const Mesh& mesh);

/// Appends the mirror image of every vertex with x > 0 (those on x = 0 are shared unless `keep_apart` says otherwise)
/// and of every triangle; gives for each vertex the index of its image.
std::vector<Index> mirror_across_x(Mesh& mesh, std::span<const char> keep_apart = {});

}  // namespace blush::make_face
