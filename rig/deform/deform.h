#pragma once
/// Deformation on the CPU: the whole of what stream-out does. Reference of the GPU path, and the path of tools that
/// have no GL.

#include <span>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "rig/deform/surface_normals.h"
#include "rig/deform/vertex_path.h"
#include "rig/face.h"

namespace blush {

/// Attributes of a deformed face, one entry a vertex of the face, in mesh-local space.
struct DeformedSurface {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Vec4> tangents;
};

/// One face on one thread, by the vertex path (rig/deform/vertex_path.h).
class Deformer {
public:
    /// Keeps a reference to `face`, which must outlive it. Packs its targets and builds the topology of its normals.
    explicit Deformer(const Face& face, const PackOptions& options = {}) : path_(face, options) {}

    /// weights: one for each target, any float (not finite counts as 0). Writes `out`, which allocates on first use
    /// only. All weights zero give the rest attributes bit for bit.
    void deform(std::span<const float> weights, NormalMethod method, DeformedSurface& out);

    const VertexPath& path() const { return path_; }

private:
    VertexPath path_;
    ActivePieces active_;
};

/// The same surface by plain loops over the targets as they are in the face: the definition, which the vertex path is
/// held to bit by bit. Allocates.
DeformedSurface deform_plain(const Face& face, const NormalTopology& topology, std::span<const float> weights,
                             NormalMethod method);

/// Skins positions and directions in place, after the morph (glTF 2.0, 3.7.3.3): `mesh_to_world` of each joint is
/// world_from_joint * joint_from_mesh. Vertices without joint weights stay as they are.
void skin(std::span<const U16Vec4> joints, std::span<const Vec4> joint_weights, std::span<const Mat4> skinned_from_mesh,
          std::span<Vec3> positions, std::span<Vec3> normals, std::span<Vec4> tangents);

}  // namespace blush
