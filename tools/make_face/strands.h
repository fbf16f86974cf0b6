#pragma once
/// The small textures of hair, brow and lash cards: single strands with their coverage in alpha.

#include "tools/make_face/picture.h"

namespace blush::make_face {

/// Clumps of hair stand beside each other in the texture, roots at the top; each is there twice, once as the light
/// falls on it and once as it lies in the shadow of the hair above it. The first ones are of few hairs, for the
/// hairline.
inline constexpr int hair_clumps = 8, sparse_hair_clumps = 2;
struct ClumpArea {
    double left, right, top, bottom;  ///< texture coordinates, v down
};
ClumpArea hair_clump(int clump, bool shaded);

/// RGBA, twice as high as wide. Colour: shares of the hair's own colour, which the material gives as its factor.
Picture paint_hair_strands(int width);
/// RGBA: a tuft of single hairs, thinner to the tip. Roots at the top.
Picture paint_brow_strands(int side);
/// RGBA: lashes that stand in small groups, thinner to the tip. Roots at the top.
Picture paint_lash_strands(int side);

}  // namespace blush::make_face
