#pragma once
/// The skin of the head as a mesh of any size: samples of one grid (coarse_head.h) that is slit at the eyes and the
/// mouth; strips that turn inward from the slits give the lids and lips their thickness and line the
/// mouth.

#include <cstddef>
#include <vector>

#include "tools/make_face/mesh.h"

namespace blush::make_face {

/// `cut`: the level face that closes the bust below.
enum class Part : std::uint8_t { skin, lid_lining, mouth_lining, ear, cut };

/// What the expression models need to know of a vertex besides its place.
struct VertexTag {
    Part part = Part::skin;
    int lid = 0;       ///< +1 above the slit of the eye on its side, -1 below, 0 at its corners and beside it
    int lip = 0;       ///< +1 above the slit of the mouth, -1 below, 0 at its corners and beside it
    double depth = 0;  ///< linings: 0 at the edge of lid or lip, 1 at the innermost ring
    Index edge = 0;    ///< linings and edges: the vertex of the lid's or lip's edge that this one hangs on; else itself
};

struct Head {
    Mesh mesh;
    std::vector<VertexTag> tags;
    std::vector<Index> image;  ///< of each vertex, its mirror image
    std::vector<Index> weld;   ///< of each vertex, the one whose normal it shares across the texture's seam
    std::vector<Index> upper_lid,
        lower_lid;  ///< edges of the left eye from the inner to the outer corner, equal in length
    std::vector<Index> upper_lip, lower_lip;  ///< edges of the left half from the middle to the corner, equal in length
};

inline constexpr std::size_t least_vertices = 5'000, most_vertices = 1'000'000;

/// About `vertices` vertices. Every size is a sample of the same surface (coarse_head.h).
Head make_head(std::size_t vertices);

/// Fills mesh.normals from its positions, the same on both halves.
std::vector<Vec3> head_normals(const Head& head, std::span<const Vec3> positions);

}  // namespace blush::make_face
