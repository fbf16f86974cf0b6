/// What a character publishes of its surface: Character::surface().

#include "runtime/surface.h"

#include <glm/glm.hpp>

#include "runtime/character.h"
#include "runtime/frame/character_state.h"

namespace blush {
namespace {

VertexBuffer attribute(const gl::Buffer& buffer, std::uint32_t components, std::size_t vertices) {
    return {buffer.name(), components, components * static_cast<std::uint32_t>(sizeof(float)),
            static_cast<std::uint32_t>(vertices)};
}

}  // namespace

PublishedSurface Character::surface() const {
    CharacterState& character = *state_;
    PublishedSurface published;
    if (character.surface == nullptr) return published;
    const Face& face = character.face;
    const SurfaceBuffers& buffers = *character.surface;
    const std::size_t count = face.positions.size();
    published.positions = attribute(buffers.positions, 3, count);
    published.normals = attribute(buffers.normals, 3, count);
    published.tangents = attribute(buffers.tangents, 4, count);
    published.uv0 = attribute(character.model->uv0, 2, count);
    published.uv1 = attribute(character.model->uv1, 2, count);
    published.indices = character.model->indices.name();
    published.index_count = static_cast<std::uint32_t>(face.indices.size());
    character.published.clear();
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        const Node& node = face.nodes[n];
        if (node.mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(node.mesh)];
        const std::size_t entry = node.skin >= 0 && !face.joints.empty() ? face.nodes.size() : n;
        const glm::dmat4& world = character.stance.world_from_node[entry];
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            if (primitive.index_count == 0) continue;
            character.published.push_back({primitive.first_index, primitive.index_count, primitive.first_vertex,
                                           primitive.vertex_count, primitive.material, static_cast<std::uint32_t>(n),
                                           world, glm::determinant(glm::dmat3(world)) < 0});
        }
    }
    published.primitives = character.published;
    return published;
}

}  // namespace blush
