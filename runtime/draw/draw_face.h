#pragma once
/// Draws the primitives of a face; what is bound for each of them is the caller's.

#include "runtime/frame/character_state.h"

namespace blush {

inline bool is_blended(const Face& face, const Primitive& primitive) {
    return primitive.material >= 0 &&
           face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::blend;
}

/// Calls visit(primitive, entry of the draw blocks, mirrored) for every primitive of every node that draws. Of a
/// skinned mesh the surface stands in the world already: its entry is the last one, the identity.
template <class Visit>
void each_drawn_primitive(const CharacterState& state, Visit visit) {
    for (std::size_t n = 0; n < state.face.nodes.size(); ++n) {
        const Node& node = state.face.nodes[n];
        if (node.mesh < 0) continue;
        const Mesh& mesh = state.face.meshes[static_cast<std::size_t>(node.mesh)];
        const bool skinned = node.skin >= 0 && state.facts.has_joints;
        const bool mirrored = !skinned && glm::determinant(glm::mat3(state.world_from_node[n])) < 0;
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = state.face.primitives[mesh.first_primitive + p];
            if (primitive.index_count != 0) visit(primitive, skinned ? state.face.nodes.size() : n, mirrored);
        }
    }
}

/// Draws a primitive with what is bound, and counts its triangles.
void draw_elements(CharacterState& state, const Primitive& primitive);

/// Writes where every node stands into the draw blocks.
void write_draw_blocks(CharacterState& state);

}  // namespace blush
