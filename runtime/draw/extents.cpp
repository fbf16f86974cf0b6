#include "runtime/draw/extents.h"

#include <algorithm>

namespace blush {

Extents find_extents(const Face& face) {
    Extents extents;
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        Bounds bounds;
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
                bounds.add(face.positions[primitive.first_vertex + v]);
            }
        }
        if (mesh.primitive_count != 0) extents.parts.push_back({n, bounds});
    }
    for (const Target& target : face.targets) {
        float reach = 0;
        for (const glm::vec3& delta : target.position_deltas) reach = std::max(reach, glm::length(delta));
        extents.target_reach.push_back(reach);
    }
    return extents;
}

}  // namespace blush
