#include "rig/deform/deform.h"

namespace blush {

void Deformer::deform(std::span<const float> weights, NormalMethod method, DeformedSurface& out) {
    const std::size_t count = path_.targets().vertex_count;
    out.positions.resize(count);
    out.normals.resize(count);
    out.tangents.resize(count);
    active_.build(path_.targets(), weights);
    const VertexPath::Job job{&active_, method, out.positions, out.normals, out.tangents};
    path_.add_targets({&job, 1}, path_.all_vertices());
    path_.turn_normals({&job, 1}, path_.all_vertices());
}

DeformedSurface deform_plain(const Face& face, const NormalTopology& topology, std::span<const float> weights,
                             NormalMethod method) {
    DeformedSurface out{face.positions, face.normals, face.tangents};
    std::vector<ActiveTarget> active;
    find_active(weights, active);
    if (active.empty()) return out;
    add_targets(face, active, out.positions, out.normals, out.tangents);

    for (const Primitive& primitive : face.primitives) {
        if (primitive.normal_source == NormalSource::rest) continue;
        const bool recomputed = normals_recomputed(primitive, method);
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            const glm::vec3 rest_normal = face.normals[v];
            const glm::vec4 rest_tangent = face.tangents[v];
            glm::vec3& normal = out.normals[v];
            glm::vec4& tangent = out.tangents[v];
            if (recomputed) {
                // TANGENT deltas belong to NORMAL deltas that are not used here.
                tangent = rest_tangent;
                normal = turned_normal(rest_normal, topology.rest_sums[v],
                                       angle_weighted_normal(topology, out.positions, v));
            } else if (normal != rest_normal) {
                normal = normalized_or(normal, rest_normal);
            }
            // What no target changed keeps its bits.
            if (normal != rest_normal || tangent != rest_tangent) {
                tangent = orthogonal_tangent(tangent, normal, rest_tangent);
            }
        }
    }
    return out;
}

void skin(std::span<const glm::u16vec4> joints, std::span<const glm::vec4> joint_weights,
          std::span<const glm::mat4> skinned_from_mesh, std::span<glm::vec3> positions, std::span<glm::vec3> normals,
          std::span<glm::vec4> tangents) {
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const glm::vec4 weights = joint_weights[v];
        if (weights == glm::vec4(0)) continue;
        glm::mat4 blended(0);
        for (glm::length_t i = 0; i < 4; ++i) {
            if (weights[i] != 0) blended += weights[i] * skinned_from_mesh[joints[v][i]];
        }
        positions[v] = glm::vec3(blended * glm::vec4(positions[v], 1));
        const glm::mat3 turn(blended);
        normals[v] = normalized_or(turn * normals[v], normals[v]);
        tangents[v] =
            orthogonal_tangent(glm::vec4(turn * glm::vec3(tangents[v]), tangents[v].w), normals[v], tangents[v]);
    }
}

}  // namespace blush
