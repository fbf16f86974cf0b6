#pragma once
/// Short hair: where it grows, how far it stands off the scalp, its colour.

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

/// 0 on bare skin, 1 well inside the hairline.
double hair_cover(const Vec3& p);

/// Millimetres above the hairline; negative below it.
double above_hairline(const Vec3& p);

/// The direction of the whorl at the crown's back, from which all hair is combed.
Vec3 hair_whorl();

/// How much of the skin's colour the hair hides: single strands at the hairline, all of it farther in.
double hair_paint(const Vec3& p);

/// Millimetres by which grow_hair() lifts the scalp, in the mean.
double hair_thickness(const Vec3& p);

/// Lifts the scalp to the thick of the hair, in strands that run from the crown's whorl; hair_cards.h stands on it.
void grow_hair(Head& head);

/// Height of the strands over the mean surface of the hair, millimetres.
double hair_relief(const Vec3& p);

/// How light the scalp's painted strands are, as a factor on the hair's colour.
double hair_shade(const Vec3& p);

}  // namespace blush::make_face
