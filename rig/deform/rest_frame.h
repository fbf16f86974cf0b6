#pragma once
/// Normals and tangents of a surface at rest, for files that leave them out.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/vectors.h"

namespace blush {

/// A unit vector at right angles to `unit`. Never fails: a zero or non-finite `unit` gives (1, 0, 0).
Vec3 any_perpendicular(Vec3 unit);

/// For each vertex the lowest-numbered vertex at the same position: file formats split vertices at texture seams.
std::vector<std::uint32_t> weld(std::span<const Vec3> positions);

/// Smooth vertex normals: the sum of the normals of the triangles around a vertex, each weighted by its angle there (as
/// in rig/deform/surface_normals.h), where vertices at the same position count as one vertex (file formats split
/// vertices at texture seams). Unit length always; a vertex that no triangle of positive area touches gets (0, 0, 1).
/// `triangles`: three indices into `positions` a triangle, counter-clockwise seen from outside.
std::vector<Vec3> smooth_normals(std::span<const Vec3> positions, std::span<const std::uint32_t> triangles);

/// Tangents for normal maps: xyz is the direction in which u grows on the surface (area-weighted over the triangles
/// around the vertex, then made perpendicular to the normal), w the side: bitangent = cross(normal, xyz) * w points
/// to where v falls, which is up in the image, since glTF has v = 0 at its upper edge and a normal map's green stand
/// for up (glTF 2.0, 3.8.2 and 3.9.3). So w = -1 where the texture is mirrored as seen from outside. Unit length
/// always; where the texture coordinates have no gradient, any perpendicular and +1. `normals` are of unit length; all
/// spans but `triangles` have one entry a vertex. The gradient of the texture coordinates over a triangle is Lengyel's
/// ("Foundations of Game Engine Development 2: Rendering", 7.5).
std::vector<Vec4> tangents_from_uv(std::span<const Vec3> positions, std::span<const Vec3> normals,
                                   std::span<const Vec2> uv, std::span<const std::uint32_t> triangles);

}  // namespace blush
