#pragma once
/// Which of a face's materials are skin, and how large the face is in millimetres.

#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/face.h"

namespace blush {

/// For each material of the face, then for the default material (primitives with material -1): whether it is skin.
/// Material::skin decides where the file says so. Else the name does: a part that is never skin (eye, teeth, lash,
/// hair,
/// ...) before one that is (skin, face, head, ...). When no name says skin, it is the material, not named as another
/// part, that the most triangles use. A blended material never is: light does not scatter in a film.
std::vector<bool> skin_materials(const Face& face);

/// Millimetres a unit of a face with these bounds (in the world). glTF's unit is the metre; a largest extent of 0.15 to
/// 0.6 is taken as that. Any other extent is taken as a head of 240 mm. Always finite and above 0.
double millimetres_a_unit(const Bounds& bounds);

}  // namespace blush
