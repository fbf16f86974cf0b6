#pragma once
/// What part of a head a material covers, told from its name.

#include <vector>

#include "rig/face.h"

namespace blush {

enum class MaterialKind : std::uint8_t {
    skin,   ///< skin_materials() says so
    eye,    ///< the eyeball: sclera, iris, cornea
    mouth,  ///< what lies behind the lips: teeth, gums, tongue
    hair,   ///< hair, brows, lashes, beard
    other,
};

/// For each material of the face, then for the default material.
std::vector<MaterialKind> material_kinds(const Face& face);

}  // namespace blush
