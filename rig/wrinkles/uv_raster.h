#pragma once
/// Which point of a face's surface each texel of its UV layout shows: what bakers stand on.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rig/face.h"

namespace blush {

/// A point on a triangle of a face.
struct UvTexel {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t triangle = none;  ///< number of the triangle: its corners are indices[3 * triangle + 0, 1, 2]
    Vec3 corner_weights{0, 0, 0};   ///< barycentric, sum 1
};

/// The UV layout of (some primitives of) a face at the centres of width x height texels, rows from the top: v runs
/// down, as in glTF.
struct UvRaster {
    std::uint32_t width = 0, height = 0;
    std::vector<UvTexel> texels;
    std::uint32_t overlaps = 0;  ///< texels that more than one triangle claims; the first keeps them

    bool covered(std::size_t texel) const { return texels[texel].triangle != UvTexel::none; }

    /// What `of_vertex` (one entry for each vertex of the face) is at a covered texel.
    template <class T>
    T interpolate(const Face& face, std::size_t texel, std::span<const T> of_vertex) const {
        const UvTexel& at = texels[texel];
        const std::uint32_t* const corners = &face.indices[std::size_t{at.triangle} * 3];
        return of_vertex[corners[0]] * at.corner_weights[0] + of_vertex[corners[1]] * at.corner_weights[1] +
               of_vertex[corners[2]] * at.corner_weights[2];
    }
};

/// primitives: one entry for each of face.primitives, 0 leaves it out. uv_set: 0 or 1. Triangles beyond the unit square
/// count where a repeated texture shows them; triangles without an area in UV cover nothing.
UvRaster rasterize_uv(const Face& face, std::span<const std::uint8_t> primitives, std::uint32_t uv_set,
                      std::uint32_t width, std::uint32_t height);

/// For each texel the nearest covered one (itself where covered), so that filtered lookups at the edge of a chart meet
/// sensible values. Distances by the two-pass sweep of Danielsson (1980), exact but for rare ties. Empty when nothing
/// is covered.
std::vector<std::uint32_t> nearest_covered(const UvRaster& raster);

}  // namespace blush
