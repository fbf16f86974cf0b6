#pragma once
/// From surfaces in their authors' numbering to a Face: polygons become triangles, corners become vertices, dense
/// expressions become sparse targets with normals.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rig/face.h"
#include "runtime/files/obj/polygons.h"

namespace blush::load {

/// A surface at rest and at each target's weight 1, with the angle-weighted normals of both (over the whole surface, so
/// that no seam between materials or texture islands shows).
class Surface {
public:
    /// targets[t]: one position a vertex of `polygons`, in the order of the assembler's names; empty where the target
    /// does not move this surface.
    Surface(Polygons polygons, std::vector<std::vector<glm::dvec3>> targets);

    const Polygons& polygons() const { return polygons_; }

private:
    friend class HeadAssembler;
    Polygons polygons_;
    std::vector<std::vector<glm::dvec3>> targets_;
    std::vector<glm::vec3> normals_;
    std::vector<std::vector<glm::vec3>> target_normals_;
};

/// Some polygons of a surface, with one material.
struct Piece {
    std::int32_t material = -1;
    std::vector<std::uint32_t> polygons;
};

class HeadAssembler {
public:
    /// A delta shorter than `least_delta` (in the surfaces' unit) counts as none.
    HeadAssembler(std::span<const std::string> target_names, double least_delta);

    /// Adds a mesh, one primitive a piece (empty ones are left out), and its node below `parent`. Vertices come in the
    /// order of the surface's numbers; a vertex with several texture coordinates becomes several. A quad is cut from
    /// its first corner, as are larger polygons.
    void add_mesh(const std::string& name, const Surface& surface, std::span<const Piece> pieces, std::int32_t parent);

    Face face;

private:
    double least_delta_;
};

/// The numbers of all polygons for which `wanted` holds.
template <class Wanted>
std::vector<std::uint32_t> polygons_where(const Polygons& polygons, Wanted wanted) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < polygons.polygons.size(); ++i) {
        if (wanted(polygons.polygons[i])) found.push_back(i);
    }
    return found;
}

/// True when `holds(corner)` for every corner of the polygon.
template <class Holds>
bool all_corners(const Polygons& polygons, const Polygons::Polygon& polygon, Holds holds) {
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
        if (!holds(polygons.corners[polygon.first_corner + c])) return false;
    }
    return true;
}

}  // namespace blush::load
