#pragma once
/// Painting eyes, gum and tongue, sRGB.

#include "tools/make_face/picture.h"

namespace blush::make_face {

/// Sclera, iris and pupil in the eye's own polar layout. `iris_color`: sRGB, 0 to 1, of the iris' outer half.
Picture paint_eye(int side, const Vec3& iris_color);

/// Teeth (u from the middle incisors, 0.5, to the last molars, 1): ivory, in the shade of the cheeks farther back.
Picture paint_teeth(int side);
/// Gum (v from its front over the teeth to its back) and tongue (v from root to tip): both darken toward the throat,
/// where no light reaches.
Picture paint_gum(int side);
Picture paint_tongue(int side);

}  // namespace blush::make_face
