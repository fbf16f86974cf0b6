#pragma once
/// Where on the face what kind of skin is: soft regions, each from 0 to 1, on the rest head.

#include "tools/make_face/surface_texels.h"

namespace blush::make_face {

/// Red lip. Its outline is the cupid's bow above and one arc below.
double lip_cover(const Vec3& p);
/// The pale ridge that borders the red lip.
double lip_border(const Vec3& p);
/// The line where the closed lips meet.
double lip_seam(const Vec3& p);

/// The rim of the upper or lower lid, where the lashes root.
double lid_rim(const Vec3& p, bool upper);
/// The thin skin all around the eye.
double around_eye(const Vec3& half);
/// The inside of a nostril.
double nostril(const SurfaceTexel& texel);

/// Forehead, nose and chin, where the skin is oily.
double oily(const Vec3& half);
/// Temple and cheekbone, where it is dry.
double temple(const Vec3& half);
/// Nose and the cheeks beside it, where pores are wide.
double wide_pored(const Vec3& half);

}  // namespace blush::make_face
