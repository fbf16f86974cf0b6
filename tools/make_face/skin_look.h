#pragma once
/// What a face's surface looks like, apart from its shape.

#include "rig/skin_colour.h"
#include "tools/make_face/geometry.h"

namespace blush::make_face {

struct SkinLook {
    double melanin = 0.02;         ///< C_m of the typical skin of the face, 0 to largest_melanin
    double melanin_blend = 0.61;   ///< share of eumelanin in it, 0 to 1
    double hemoglobin = 0.013;     ///< C_hd of the typical skin at rest, 0 to largest_hemoglobin
    Vec3 hair{0.29, 0.20, 0.135};  ///< sRGB, 0 to 1: of hair in the light; brows and lashes are darker
    Vec3 eyes{0.31, 0.355, 0.33};  ///< sRGB, 0 to 1: of the iris' outer half
    double freckles = 0.25;        ///< 0 none, 1 many
};

}  // namespace blush::make_face
