#pragma once
/// The head as one implicit surface: ellipsoids and round cones under a smooth minimum, and the landmarks they hang on.
///
/// Proportions follow the adult averages of Farkas, "Anthropometry of the Head and Face" (2nd ed. 1994), men's and
/// women's means averaged and rounded: head height 225 mm, head length 190, head breadth 150, face breadth 135,
/// nasion to gnathion 117, nasion to subnasale 51, subnasale to stomion 21, intercanthal 34, mouth breadth 51, nose
/// breadth 35. The eyes are drawn somewhat larger than life (radius 13.5 instead of 12), a portrait's licence.

#include "tools/make_face/geometry.h"

namespace blush::make_face {

/// Places on the face's left half, millimetres.
namespace landmark {
inline constexpr double eye_radius = 13.5;
inline constexpr Vec3 eye_centre{32, -1, 69};
inline constexpr double lid_thickness = 1.9;
inline constexpr Vec2 inner_canthus{17.2, -2.6}, outer_canthus{46.2, -0.6};  ///< x, y
inline constexpr double mouth_corner_x = 25.5;
inline constexpr double stomion_y = -68;
inline constexpr Vec3 jaw_hinge{0, -24, 4};  ///< the axis through both condyles is parallel to X
inline constexpr Vec3 ear_centre{69.0, -12, -13};
inline constexpr Vec3 fan_origin{0, -10, 5};  ///< the head's skin is star-shaped seen from here, nearly
}  // namespace landmark

/// Signed distance, nearly, to the bald head without lids' opening and ears: negative inside.
double head_distance(const Vec3& p);

/// Unit gradient of head_distance.
Vec3 head_normal(const Vec3& p);

/// The first place where a ray from inside leaves the head.
Vec3 leave_head(const Vec3& origin, const Vec3& direction);

/// The nearby place on the surface, along the gradient.
Vec3 project_to_head(const Vec3& p);

/// Sinks the surface into the nostrils: they are pits behind an edge, which no ray from inside the head could tell.
Vec3 sink_nostril(const Vec3& p);
/// How deep in a nostril a place of the finished skin lies: 0 outside, 1 at its ground.
double nostril_depth(const Vec3& p);

/// Height of the upper and lower lid's edge over the line between the canthi (both positive), at x on the left eye.
double upper_lid_height(double x);
double lower_lid_height(double x);
/// y of the line between the canthi.
double canthal_y(double x);
/// y of the line where the closed lips meet, at |x| up to the mouth's corner.
double lip_line_y(double x);
/// Height of the red of the upper and lower lip over and under that line (both positive).
double upper_lip_height(double x);
double lower_lip_height(double x);

}  // namespace blush::make_face
