#pragma once
/// Painting: colours as functions of the place on the rest head, filled into the texture through its own triangles.

#include <vector>

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

/// An 8-bit RGB image, rows from the top.
struct Picture {
    int side = 0;
    std::vector<unsigned char> rgb;
};

/// The skin's base colour, sRGB: tone, blood at cheeks, nose, ears and lips, brows, the lids' dark rims, cropped hair.
Picture paint_skin(const Head& head, int side);
/// Tangent-space normal map of pores and fine skin relief (OpenGL convention: green up).
Picture paint_pores(const Head& head, int side);
/// Roughness of the skin in the green channel, metallic (none) in the blue, as glTF has them: hair, skin, lips, lining.
Picture paint_roughness(const Head& head, int side);
/// Sclera, iris and pupil, sRGB, in the eye's own polar layout.
Picture paint_eye(int side);

/// Gum (v from its front over the teeth to its back) and tongue (v from root to tip), sRGB: both darken toward the
/// throat, where no light reaches.
Picture paint_gum(int side);
Picture paint_tongue(int side);

std::vector<unsigned char> png(const Picture& picture);

}  // namespace blush::make_face
