#pragma once
/// Where skin wrinkles, as places on the mean face (rig/head/canonical_face.h). Strain says where and how strongly skin
/// is pressed together; it cannot say that a cheek which is pushed up as a whole does not fold. Anatomy does.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/head/canonical_face.h"
#include "rig/vectors.h"

namespace blush {

/// A stroke: all within `radius_mm` of the line between its ends, fading out from `solid_share` of that. Of a zone
/// whose name ends in "Right" the ends are mirrored.
struct WrinkleZonePlace {
    std::string_view name;
    Vec2 from_mm, to_mm;  ///< canonical, of the left one of a pair
    float radius_mm = 1;
    bool crease = false;  ///< one fold, whose valley is the line itself; else as many as the compression asks for
};

/// The first eight are those of jimenez-2012, table 8.1, in its order. The paper names them by the colours of figure
/// 8.3; which is where, and which of a pair is left, is read from the weights and from figure 8.6 (Frontalis, Nasalis,
/// Mentalis). The other four are ours: the thesis leaves cheeks to the mesh (8.3), and has a smile wrinkle the outer
/// zones, which then reach down to the corners of the eyes. Places by the landmarks of Farkas 1994: hairline 65 mm
/// above the pupils, brows 20, outer corner of the eye at 48 from the midline, wing of the nose at 17 and 38 below,
/// corner of the mouth at 26 and 68 below.
extern const std::array<WrinkleZonePlace, 12> wrinkle_zone_places;

/// A zone laid over a face: what bake_wrinkles() takes.
struct WrinkleZoneField {
    ScalarMap share;      ///< 0 to 1; without texels: everywhere
    ScalarMap crease_mm;  ///< distance from the line of the one fold, signed; without texels: no such line
};

/// Whether a place lies within the radius of any of these zones.
bool in_a_zone(std::span<const std::string> zones, Vec2 canonical_mm);

/// For each of `zones` its place in the layout of `map`. Names that are none of wrinkle_zone_places are everywhere.
std::vector<WrinkleZoneField> wrinkle_zone_fields(std::span<const std::string> zones, const CanonicalMap& map);

}  // namespace blush
