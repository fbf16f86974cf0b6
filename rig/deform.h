#pragma once
/// Deformation on the CPU: the whole of what stream-out does, as plain loops. Reference of the GPU path, and the path
/// of tools that have no GL.

#include <span>
#include <vector>

#include "rig/blend_shapes.h"
#include "rig/face.h"
#include "rig/surface_normals.h"

namespace blush {

/// Attributes of a deformed face, one entry a vertex of the face, in mesh-local space.
struct DeformedSurface {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
};

class Deformer {
public:
    /// Keeps a reference to `face`, which must outlive it. Builds the topology that the normals need.
    explicit Deformer(const Face& face) : face_(face), topology_(face) {}

    /// weights: one for each target, any float (not finite counts as 0). Writes `out`, which allocates on first use
    /// only. All weights zero give the rest attributes bit for bit.
    void deform(std::span<const float> weights, NormalMethod method, DeformedSurface& out);

    const NormalTopology& topology() const { return topology_; }

private:
    const Face& face_;
    NormalTopology topology_;
    std::vector<ActiveTarget> active_;
};

/// Skins positions and directions in place, after the morph (glTF 2.0, 3.7.3.3): `mesh_to_world` of each joint is
/// world_from_joint * joint_from_mesh. Vertices without joint weights stay as they are.
void skin(std::span<const glm::u16vec4> joints, std::span<const glm::vec4> joint_weights,
          std::span<const glm::mat4> skinned_from_mesh, std::span<glm::vec3> positions, std::span<glm::vec3> normals,
          std::span<glm::vec4> tangents);

}  // namespace blush
