#pragma once
/// Short hair as layers of strips with strands painted on them, from the roots on the scalp along the way they are
/// combed; the scalp's own paint is what is seen between them.

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

struct HairStyle {
    double length = 1;  ///< factor on every strip's length
    double lift = 1;    ///< factor on how far the hair stands off the scalp
    double sweep = 1;   ///< how far the fringe is combed to the face's right; negative: to its left
};

struct HairCards {
    Mesh mesh;
    std::vector<Vec3> roots;  ///< of each vertex, where its strip grows out of the scalp
};

/// From the innermost layer to the outermost, the order in which they blend over each other. Every strip has triangles
/// for both sides, so that its back is shaded as the head of hair is, too, and not as the back of a strip.
HairCards make_hair_cards(const HairStyle& style = {});

}  // namespace blush::make_face
