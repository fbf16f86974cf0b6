#pragma once
/// The skin's relief below what vertices can hold, and how it shines.

#include "tools/make_face/picture.h"
#include "tools/make_face/surface_texels.h"

namespace blush::make_face {

/// Tangent-space normals (green up): pores, wide on nose and cheeks; fine crossing lines that are coarser on the
/// forehead and finer about the eyes; upright furrows on the lips; strands on the scalp.
/// `aged`: 0 young, 1 old: how deep the lines of forehead, eye's corner and neck have become.
Picture paint_relief(const SurfaceTexels& texels, double aged = 0);

/// Red: how much of the surroundings the place sees (glTF's occlusion). Green: roughness: oily forehead, nose and chin,
/// drier cheeks, moist lips, wet rims of the lids. Blue: metallic, none.
Picture paint_roughness(const SurfaceTexels& texels);

/// Alpha: intensity of the reflection (KHR_materials_specular): full on oily skin and lips, less on cheeks, none where
/// no light reaches and under hair. Red to blue are white.
Picture paint_specular(const SurfaceTexels& texels);

}  // namespace blush::make_face
