#pragma once
/// The left ear as a patch of its own: concha, antihelix, scapha and rolled helix in rings round the canal, then its
/// back.

#include "tools/make_face/mesh.h"

namespace blush::make_face {

/// Appends the ear to a mesh. `fineness` 1 gives about 1,200 vertices. Texture coordinates fill the square at
/// `uv_corner`.
void add_left_ear(Mesh& mesh, double fineness, const Vec2& uv_corner, double uv_side);

}  // namespace blush::make_face
