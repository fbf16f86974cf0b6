#pragma once
/// ARKit's 52 blend shapes (Apple, ARFaceAnchor.BlendShapeLocation) from models of what moves: the jaw turns about its
/// hinge, the lids turn about the eye's centre, muscles pull soft regions of the skin. Left and right are exact mirror
/// images: every left shape is computed once and its right twin is copied through the mesh's mirror table.

#include <string>
#include <vector>

#include "tools/make_face/eyes.h"
#include "tools/make_face/head_mesh.h"
#include "tools/make_face/write_glb.h"

namespace blush::make_face {

/// The jaw's share of a turn at full opening, radians, and where a point of the mandible goes at a share of it.
inline constexpr double jaw_open_angle = 21 * pi / 180;
Vec3 jaw_opened(const Vec3& p, double share);

/// All targets that move the head's skin (51: all but tongueOut).
std::vector<ShapeTarget> head_targets(const Head& head);

/// jawOpen, jawForward, jawLeft, jawRight of a mesh that is fixed to the mandible.
std::vector<ShapeTarget> mandible_targets(const Mesh& mesh);

/// The targets of the head that move its lids, for lashes that hang on them.
std::vector<ShapeTarget> lash_targets(const Lashes& lashes, const Head& head,
                                      const std::vector<ShapeTarget>& head_targets);

/// The tongue's: those of the mandible, and tongueOut.
std::vector<ShapeTarget> tongue_targets(const Mesh& tongue);

}  // namespace blush::make_face
