#pragma once
/// Normals and tangents of a deformed surface.
///
/// A normal that targets carry themselves is normalised after the sum. Every other normal turns with the surface: the
/// angle-weighted normal of the triangles around the vertex (Thuermer and Wuethrich 1998) is taken at rest and after
/// deformation, and the rotation from the one to the other (the shortest arc) is applied to the rest normal. So hard
/// edges and the artist's own smoothing stay, a flat weight gives the rest normal bit for bit, and the normal is exact
/// for rigid motion.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// Which normals are turned with the surface instead of taken from NORMAL deltas.
enum class NormalMethod : std::uint8_t {
    authored,    ///< only where some target has no NORMAL deltas (Primitive::normal_source)
    recomputed,  ///< everywhere that a target moves the surface
};

/// True when the normals of `primitive` are turned with the surface under `method`.
bool normals_recomputed(const Primitive& primitive, NormalMethod method);

/// The triangles around each vertex. Vertices of one primitive with the same rest position and the same rest normal
/// (the two sides of a seam in the texture coordinates) share their triangles, so that no seam opens in the shading.
struct NormalTopology {
    explicit NormalTopology(const Face& face);

    std::vector<std::uint32_t> first_triangle;  ///< of each vertex, and one past the last: vertices + 1 entries
    /// The vertices (a, b, c) of each triangle around a vertex, starting with the vertex (or its copy across a seam).
    std::vector<UVec3> triangles;
    std::vector<Vec3> rest_sums;  ///< angle-weighted normal at rest, unnormalised; zero where no triangle has an area
};

/// Sum of the unit normals of the triangles around `vertex`, each times its angle (radians) at the vertex: a direction
/// that does not depend on how the surface is cut into triangles. Triangles without an area or with an edge shorter
/// than 1e-15 add nothing.
Vec3 angle_weighted_normal(const NormalTopology& topology, std::span<const Vec3> positions, std::uint32_t vertex);

/// The rest normal turned by the rotation that takes `rest_sum` to `deformed_sum` (neither need be normalised).
/// Where either is shorter than 0.001 radians (a fan without area, or one whose triangles face each other, as those of
/// a card with both sides do), the rest normal itself. Half a turn has no shortest arc: beyond 179.9 degrees the normal
/// of the deformed surface is taken.
Vec3 turned_normal(Vec3 rest_normal, Vec3 rest_sum, Vec3 deformed_sum);

/// v / |v|, or `fallback` where |v|^2 is not between 1e-30 and 1e37 (no direction, or about to overflow).
Vec3 normalized_or(Vec3 v, Vec3 fallback);

/// The tangent made orthogonal to `normal` again; where nothing remains of it, `rest_tangent`. w is kept.
Vec4 orthogonal_tangent(Vec4 tangent, Vec3 normal, Vec4 rest_tangent);

}  // namespace blush
