#pragma once
/// What an open mouth shows: two rows of teeth, their gums and the tongue.

#include "tools/make_face/mesh.h"

namespace blush::make_face {

enum class Jaw : std::uint8_t { upper, lower };

/// Fourteen teeth as one band along the dental arch, each with its own bulge and edge.
Mesh make_teeth(Jaw jaw);
/// How far a place lies behind the front of the row of teeth and its gum, at rest: millimetres inward from the arch's
/// ellipse, widened by `clearance_mm`; 0 outside of it, above and below it.
double depth_in_teeth(Jaw jaw, const Vec3& p, double clearance_mm = 0);
/// The same place moved straight outward until it stands before them.
Vec3 before_teeth(Jaw jaw, const Vec3& p, double clearance_mm);
/// The gum that they stand in.
Mesh make_gum(Jaw jaw);
Mesh make_tongue();
/// How far the tongue's vertex moves when the tongue comes out, millimetres.
Vec3 tongue_out(const Vec3& p);

}  // namespace blush::make_face
