#pragma once
/// Where an expression or a state of the body fills and drains the face, written down once for the mean face and laid
/// over any face by rig/head/canonical_face.h.

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/blood/appearance.h"
#include "rig/blood/hemoglobin.h"
#include "rig/head/canonical_face.h"
#include "rig/vectors.h"

namespace blush {

/// A region with a soft edge: full at its centre, e^-1 of it on the ellipse, by a bell (a Gaussian).
struct SoftEllipse {
    std::string name;
    Vec2 centre_mm{0};        ///< canonical
    Vec2 radii_mm{10};        ///< above 0
    float angle_radians = 0;  ///< of the first radius from +x towards +y
    bool mirrored = true;     ///< there is one on the other side too (a region on the midline is not doubled by it)
    RelativeChange change;    ///< at its centre
};

struct HemoglobinPattern {
    std::string name;  ///< as in the rig's controls: "joy", "blush", ...
    RelativeChange everywhere;
    std::vector<SoftEllipse> regions;  ///< they add up
};

/// The names of the patterns that the project ships, in the order of Rig::hemoglobin_maps() of a face without a rig
/// description of its own.
extern const std::array<std::string_view, 11> hemoglobin_pattern_names;

/// The pattern's change at a place of the mean face. The mean cannot fall below -0.95: some blood always stays.
RelativeChange change_at(const HemoglobinPattern& pattern, Vec2 canonical_mm);

/// What the runtime needs of blood, at low resolution in the face's own texture layout (jimenez-2012, 7.6: 256 x 256).
struct HemoglobinMaps {
    std::vector<std::string> names;
    std::vector<HemoglobinChange> changes;  ///< one a name
};

struct HemoglobinMapOptions {
    std::uint32_t side = 256;  ///< texels of the changes, both ways
    float radius = 1 / 32.0F;  ///< of the disc of 7.1, as a share of the texture's width
};

/// The changes of each pattern on a face with these appearance maps. `canonical`: of the same texture, of any size.
HemoglobinMaps hemoglobin_maps(const AppearanceMaps& appearance, const CanonicalMap& canonical,
                               std::span<const HemoglobinPattern> patterns, const HemoglobinMapOptions& options = {});

}  // namespace blush
