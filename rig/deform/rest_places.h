#pragma once
/// Where the vertices of a face stand at rest, in the space of its file.

#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// One place a vertex: by the first node that draws it, or by its joints. Vertices that no node draws stay where their
/// mesh has them. skinned_origin: a point near the face, so that floats of skinned vertices are fine.
std::vector<DVec3> rest_places(const Face& face, DVec3 skinned_origin);

}  // namespace blush
