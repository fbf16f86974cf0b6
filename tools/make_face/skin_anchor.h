#pragma once
/// What grows out of the skin moves with it: each vertex of a card takes the displacement of the place of the skin that
/// it stands over.

#include <span>

#include "tools/make_face/head_mesh.h"
#include "tools/make_face/write_glb.h"

namespace blush::make_face {

/// A place of the head's skin: a triangle's corners and their shares, which add up to 1.
struct SkinAnchor {
    Triangle corners{};
    Vec3 shares{1, 0, 0};

    Vec3 interpolated(std::span<const Vec3> values) const {
        return values[corners[0]] * shares.x + values[corners[1]] * shares.y + values[corners[2]] * shares.z;
    }
};

/// The foremost skin (no lining, no ear) straight behind each (x, y), as seen from the front. Where there is none, the
/// nearest vertex of the skin's front.
std::vector<SkinAnchor> anchors_from_front(const Head& head, std::span<const Vec2> places);

/// The nearest vertex of the skin to each place.
std::vector<SkinAnchor> nearest_anchors(const Head& head, std::span<const Vec3> places);

/// The targets of the head that move any of the anchors, as they move a mesh that has one anchor a vertex. Normals turn
/// as the anchors' own do.
std::vector<ShapeTarget> carried_targets(const Mesh& mesh, std::span<const SkinAnchor> anchors, const Head& head,
                                         std::span<const ShapeTarget> head_targets);

}  // namespace blush::make_face
