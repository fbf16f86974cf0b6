#pragma once
/// Fills in what a file leaves out, once all of a mesh's primitives are in the Face.

#include "rig/face.h"

namespace blush::load {

/// Gives every vertex of face.meshes[mesh] that has a normal (or tangent) of zero length a computed one. Normals are
/// smooth across all primitives of the mesh; tangents follow the texture coordinates that the material's normal map
/// uses.
void fill_missing_attributes(Face& face, std::size_t mesh);

}  // namespace blush::load
