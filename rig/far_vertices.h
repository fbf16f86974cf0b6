#pragma once
/// Vertices that a file bakes far from the origin: their own floats are coarse there, and so is all that is computed
/// from them, unless they are first taken back to where floats are fine.

#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// A mesh counts as far out where its middle is this many times as far from the origin, along some axis, as the largest
/// mesh of the face reaches from its own middle: the file has then six bits less for the shape. A head on a body in
/// metres (1.6 up, 0.12 to each side) is not.
inline constexpr float far_ratio = 64;

struct Recentred {
    std::vector<Vec3> mesh_origin;  ///< of each mesh: what was taken off its vertices; 0 where they are as in the file
    std::vector<Vec3> skin_origin;  ///< of each skin: that of the meshes that follow it
};

/// Takes the vertices of meshes that are far out to near the origin, and puts the way there into the places where they
/// are drawn, so that nothing moves: a node that draws such a mesh gets a child that draws it instead (new nodes stand
/// behind all others), and joint_from_mesh of its skin is composed with it in double precision. No vertex is rounded:
/// the difference of floats within a factor of two of each other is exact (Sterbenz 1974).
Recentred recentre(Face& face);

/// The distance between neighbouring floats at the farthest coordinate of what nodes draw, in units of the file's
/// space.
double float_step(const Face& face);

}  // namespace blush
