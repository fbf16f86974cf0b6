#pragma once
/// Where a surface ends: edges that only one triangle has.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

struct OpenBorder {
    std::vector<std::uint32_t> vertices;  ///< one for each place, in order around it
    double length = 0;                    ///< of its edges at rest, in units of the file's space
    DVec3 middle{0};                      ///< of its edges, each as heavy as it is long
};

/// For each vertex the lowest one of its mesh with the same rest position: what a seam in normals or texture
/// coordinates has cut is one place.
std::vector<std::uint32_t> places_of_meshes(const Face& face);

/// The closed borders of the primitives for which `taken` holds (one entry a primitive), in the order of their lowest
/// vertices. places: rest_places().
std::vector<OpenBorder> open_borders(const Face& face, std::span<const std::uint8_t> taken,
                                     std::span<const DVec3> places);

/// Where the neck ends: of the borders that come down to the lowest tenth of the primitives' height and are at least
/// half as long as the longest of those, the lowest. Empty: there is none, as of a bust that is closed below; what is
/// open around eyes and mouth is no neck.
std::vector<std::uint32_t> neck_border(const Face& face, std::span<const std::uint8_t> taken,
                                       std::span<const DVec3> places);

}  // namespace blush
