#pragma once
/// The eyeball with its cornea's bulge, and lashes that hang on the lids' edges.

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

/// Height of the cornea over the eyeball's sphere at its apex. Life has about 2.5 mm; a flat one lets the lids lie
/// close.
inline constexpr double cornea_height = 0.55;
/// Half the angle that the cornea subtends at the eye's centre (a limbus 11.7 mm wide, on an eye drawn 1.12 times
/// life).
inline constexpr double limbus_angle = 28.5 * pi / 180;

/// Distance from the eye's centre to its surface in a direction `polar` radians off the gaze, millimetres.
double eye_radius_at(double polar);

/// An eye about its own centre, looking along +Z. Texture: polar about the pupil, the texture's edge at 100 degrees.
Mesh make_eye();
/// The pink flesh in both eyes' inner corners, in the head's space.
Mesh make_caruncles();
inline constexpr double eye_texture_angle = 100 * pi / 180;

/// Lashes of both eyes: each a tapering strip. `edge` gives for every vertex the vertex of the head's lid it hangs on;
/// `image` its mirror image.
struct Lashes {
    Mesh mesh;
    std::vector<Index> edge, image;
};
Lashes make_lashes(const Head& head);

}  // namespace blush::make_face
