#include "rig/deform/rest_places.h"

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/deform.h"
#include "rig/deform/face_part.h"

namespace blush {

std::vector<glm::dvec3> rest_places(const Face& face, glm::dvec3 skinned_origin) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    std::size_t joint_count = 0;
    for (const Skin& part : face.skins) joint_count += part.joints.size();
    std::vector<glm::mat4> joints(joint_count);
    skinned_from_meshes(face, placed, skinned_origin, joints);
    DeformedSurface rest{face.positions, face.normals, face.tangents};
    const std::vector<std::uint32_t> first_joint = first_joints(face);
    std::vector<glm::dvec3> places(face.positions.begin(), face.positions.end());
    for (std::size_t p = 0; p < face.primitives.size(); ++p) {
        const Primitive& primitive = face.primitives[p];
        const std::int32_t node = drawing_node(face, primitive.mesh);
        if (node < 0) continue;
        const auto part = [&primitive](auto& values) {
            return std::span(values).subspan(primitive.first_vertex, primitive.vertex_count);
        };
        const bool skinned = !face.joints.empty() && face.nodes[static_cast<std::size_t>(node)].skin >= 0;
        if (skinned) {
            skin(part(face.joints), part(face.joint_weights), std::span(joints).subspan(first_joint[p]),
                 part(rest.positions), part(rest.normals), part(rest.tangents));
        }
        const glm::dmat4& matrix = placed[static_cast<std::size_t>(node)];
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            const glm::dvec3 position(rest.positions[v]);
            places[v] = skinned ? position + skinned_origin : glm::dvec3(matrix * glm::dvec4(position, 1));
        }
    }
    return places;
}

}  // namespace blush
