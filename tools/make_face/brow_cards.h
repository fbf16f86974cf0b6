#pragma once
/// Brows as small cards with single hairs, which stand on the skin and move with it.

#include "tools/make_face/skin_anchor.h"

namespace blush::make_face {

/// A place of the left brow's outline: 0 at its head to 1 at its tail.
struct BrowLine {
    Vec2 middle;        ///< x, y
    double half_width;  ///< mm, across
    double lean;        ///< of the hairs there, radians from +x (outward) toward +y
};
BrowLine brow_line(double share);

/// 0 to 1: how much of the skin at a place (either side) is under a brow; soft.
double brow_cover(const Vec3& p);

struct BrowCards {
    Mesh mesh;
    std::vector<SkinAnchor> anchors;  ///< of each vertex
};
BrowCards make_brow_cards(const Head& head);

}  // namespace blush::make_face
