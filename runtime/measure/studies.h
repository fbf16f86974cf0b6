#pragma once
/// The studies of effects and bakers: which has one, and where it stands (a file each in studies/).

#include <span>
#include <string_view>
#include <vector>

#include "rig/face.h"
#include "runtime/device.h"
#include "runtime/measure/study.h"

namespace blush {

/// Makes the studies of one effect or baker on one face. None where the face has nothing to measure it on, or does not
/// fit the device. `millimetres_a_unit`: scale of the face, for errors in millimetres. `quick`: only the largest.
using StudyMaker = std::vector<Study>(const Device& device, const Face& face, double millimetres_a_unit, bool quick);

struct Studied {
    std::string_view name;           ///< of the effect or baker
    StudyMaker* make = nullptr;      ///< null: it has no study, and `why_none` says why
    std::string_view why_none = {};  ///< ends the sentence "... has no study, since"
};

/// Every effect and every baker, in the order in which frames apply them.
std::span<const Studied> studied();

namespace studies {
StudyMaker deformation, normals, skinning, pinning, wrinkle_baking, wrinkles, appearance_baking, blood, shadows,
    translucency, reflection, environment, parts, scattering, depth_of_field, bloom, exposure, multisampling,
    antialiasing, supersampling, reprojection, grain;
}  // namespace studies

}  // namespace blush
