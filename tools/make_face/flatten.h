#pragma once
/// A surface laid flat with its lengths kept as well as they can be: as rigid as possible (Liu et al. 2008).

#include <span>
#include <vector>

#include "tools/make_face/mesh.h"

namespace blush::make_face {

/// Planar places of the vertices of a half whose fold is the line x = 0, millimetres. `flat` is where to begin;
/// vertices with `on_fold` keep x = 0. `scale(p)`: how large a millimetre at p is to become. The same input gives the
/// same bits.
struct FlattenInput {
    std::span<const Vec3> positions;
    std::span<const Triangle> triangles;
    std::span<const double> scale;  ///< one a triangle
    std::span<const char> on_fold;
};
std::vector<Vec2> flatten(const FlattenInput& input, std::vector<Vec2> flat);

}  // namespace blush::make_face
