#pragma once
/// How the surface of a face hides light that comes from around it from its own vertices: nine spherical-harmonics
/// coefficients of the transfer, visibility times clamped cosine, a vertex (chappuis-2011, 3.3).
///
/// Coefficients are kept in the vertex's own frame (vertex_frame()): they turn with the deformed normal and tangent,
/// with joints, nodes and the head, as 3.4 turns the light. What deformation opens and closes is told by further poses
/// (an open jaw, closed lids), blended by the weights of their targets.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/light/spherical_harmonics.h"

namespace blush {

/// Coefficients of max(n . w, 0) V(w), in the vertex's frame.
using LightTransfer = std::array<float, 9>;

/// The transfer of every vertex in one pose.
struct OcclusionPose {
    std::string target;                    ///< the target that is at weight 1; empty: rest
    std::vector<LightTransfer> transfers;  ///< one a vertex of the face
};

/// Rest first.
struct OcclusionSet {
    std::uint64_t face_identity = 0;  ///< occlusion_identity() of the face that it was baked from
    std::vector<OcclusionPose> poses;
};

/// Poses of a set at most, rest among them.
inline constexpr std::size_t most_occlusion_poses = 8;

/// A number that tells one surface from another: of positions, triangles and what is opaque.
std::uint64_t occlusion_identity(const Face& face);

/// Whether light stops at a primitive: cut-out and blended cards would hide as much as their whole outline.
bool stops_light(const Face& face, const Primitive& primitive);

/// The frame of a vertex: z is the normal, x the part of the tangent that is perpendicular to it (any perpendicular
/// where there is none), right-handed. normal: unit length.
DMat3 vertex_frame(DVec3 normal, DVec3 tangent);

/// Directions about +z, distributed with the cosine (a Fibonacci lattice on the unit disc, lifted): each stands for
/// pi / count of max(z, 0) dw. Unit length, z above 0.
std::vector<DVec3> cosine_directions(std::uint32_t count);

/// The transfer of a vertex from which `directions` (of its frame) are hidden or not: the closed form of an open vertex
/// less the sum over what is hidden, so that an open vertex is exact however few the directions.
LightTransfer transfer_of(std::span<const DVec3> directions, std::span<const std::uint8_t> hidden);

/// Share of cosine-weighted directions that are open, 0 to 1.
double openness(const LightTransfer& transfer);

/// Irradiance / pi under light of these coefficients: what white reflects. world_from_frame: vertex_frame() in the
/// world. Nine coefficients ring, so the result is held between what is certain: no more than an open vertex gathers,
/// and no less than the open directions bring of `least_radiance`, which the light has from every side.
DVec3 occluded_ambient(const Sh9Color& radiance, const LightTransfer& transfer, const DMat3& world_from_frame,
                       DVec3 least_radiance = DVec3(0));

/// The same with the light that the surfaces around a vertex send on: what hides it shines as the vertex itself does,
/// albedo times its irradiance, so that E = direct + (1 - openness) albedo E. A white furnace stays white.
DVec3 with_bounces(DVec3 direct, double openness, DVec3 albedo);

/// Vertices that are shut in (openness below a fiftieth) take the mean of their open neighbours, and those of theirs,
/// ring by ring: of what is seen of a triangle between the two, the open corner tells. `triangles`: vertex indices.
void fill_shut_vertices(std::span<const std::uint32_t> triangles, std::vector<LightTransfer>& transfers);

/// Which pose of a set counts how much: rest has what is left of 1. `weights`: of the face's targets; one that is not
/// finite counts as 0, and more than 1 as 1. `out`: one entry a pose.
void occlusion_weights(const OcclusionSet& set, const Face& face, std::span<const float> weights, std::span<float> out);

}  // namespace blush
