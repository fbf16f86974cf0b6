#pragma once
/// Short hair: where it grows, how far it stands off the scalp, its colour.

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

/// 0 on bare skin, 1 well inside the hairline.
double hair_cover(const Vec3& p);

/// How much of the skin's colour the hair hides: single strands at the hairline, all of it farther in.
double hair_paint(const Vec3& p);

/// Lifts the scalp to the hair's outer surface, in strands that run from the crown's whorl.
void grow_hair(Head& head);

/// Height of the strands over the mean surface of the hair, millimetres.
double hair_relief(const Vec3& p);

/// sRGB, 0 to 1.
Vec3 hair_color(const Vec3& p);

}  // namespace blush::make_face
