#pragma once
/// The skin's melanin and hemoglobin, painted as such; its colour follows from them.

#include "rig/blood/appearance.h"
#include "tools/make_face/person.h"
#include "tools/make_face/picture.h"
#include "tools/make_face/surface_texels.h"

namespace blush::make_face {

/// All maps, of the texels' size. Melanin: tone, sun, freckles, moles, the eyes' rims. Hemoglobin: cheeks, nose, ears,
/// lips and rims of the eyes are fuller; vessels, uneven tone at several scales. The residual is 1 on bare skin (where
/// `look.melanin_blend` is not the table's own, the ratio of the two kinds' colours) and holds what is no pigment: hair
/// on the scalp and under the brows, the dark of mouth and nostrils.
AppearanceMaps paint_pigments(const SurfaceTexels& texels, const SkinTone& look, const SkinColourTable& table);

/// The base colour that the maps give, 8-bit sRGB.
Picture base_color(const AppearanceMaps& maps, const SkinColourTable& table);

}  // namespace blush::make_face
