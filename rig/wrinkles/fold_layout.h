#pragma once
/// The part of a face's texture layout that wrinkle maps need to show: a layout holds a neck, ears and the inside of a
/// mouth besides, and the few texels of a small map (jimenez-2012, 8.3) are better spent where skin folds.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/head/canonical_face.h"
#include "rig/wrinkles/layout_part.h"

namespace blush {

/// For each triangle of the face (three indices each), whether it is of these primitives and shows: 0 where other skin
/// lies more than 6 mm before it, seen from the axis of the head, and where it faces that axis: the inside of the mouth
/// and of the nose.
std::vector<std::uint8_t> outer_triangles(const Face& face, std::span<const std::uint32_t> primitives,
                                          const CanonicalFrame& frame);

/// The part that the zones lie in, with a margin. The whole layout where a zone has no place
/// (rig/wrinkles/wrinkle_zones.h), the layout does not lie in the unit square, or little would be gained.
LayoutPart part_of_zones(const Face& face, std::span<const std::uint8_t> triangles, const CanonicalFrame& frame,
                         std::span<const std::string> zones);

/// The face with these triangles alone and texture coordinates within the part; without images. Triangles whose middle
/// lies outside of the part are left out.
Face cropped(const Face& face, std::span<const std::uint8_t> triangles, const LayoutPart& part);

}  // namespace blush
