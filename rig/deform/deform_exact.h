#pragma once
/// The exact twin of the deformation: the same definitions in double precision, plain and slow.

#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

struct ExactSurface {
    std::vector<DVec3> positions;
    std::vector<DVec3> normals;  ///< unit length
};

/// Positions are rest + sum of weight * delta. Every normal of a primitive that targets move is the rest normal turned
/// with the deformed surface (rig/deform/surface_normals.h), whatever NORMAL deltas say: what a renderer would find if
/// it recomputed the normals of the deformed mesh. weights: one for each target, finite.
ExactSurface deform_exact(const Face& face, std::span<const float> weights);

}  // namespace blush
