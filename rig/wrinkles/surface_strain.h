#pragma once
/// How much skin is pressed together when targets move it: the strain of the surface (continuum mechanics: the right
/// Cauchy-Green tensor of each triangle).

#include <span>
#include <vector>

#include "rig/face.h"

namespace blush {

/// The principal stretches of a triangle, and the direction on the surface at rest of the smaller one.
struct Stretch {
    double least = 1, most = 1;   ///< deformed length over rest length; 1: unchanged
    DVec3 direction_of_least{0};  ///< unit; zero where the triangle has no area at rest
};

/// Of the triangle whose corners `rest` become `deformed`. A triangle without an area at rest is unchanged.
Stretch stretch_of(std::span<const DVec3, 3> rest, std::span<const DVec3, 3> deformed);

/// The compression of the skin as a tensor: sum over directions d of (1 - stretch) d d^T where the skin gets shorter.
/// Symmetric, in the mesh's axes. Tensors, unlike directions, can be averaged.
using Compression = DMat3;

/// At each vertex: mean over the triangles around it, weighted by their area at rest. Vertices at one rest position
/// share theirs: `place` is weld(face.positions) (rig/deform/rest_frame.h). deformed: one position for each vertex.
std::vector<Compression> vertex_compression(const Face& face, std::span<const std::uint32_t> place,
                                            std::span<const Vec3> deformed);

/// Largest eigenvalue within the plane across `normal`, and its direction (unit, along the plane).
struct PrincipalCompression {
    double amount = 0;  ///< 1 - stretch: 0 none, 0.3: shortened by 30 %
    DVec3 direction{0};
};
PrincipalCompression principal_compression(const Compression& tensor, DVec3 normal);

}  // namespace blush
