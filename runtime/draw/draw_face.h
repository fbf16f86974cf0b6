#pragma once
/// Draws the primitives of a character; what is bound for each of them is the caller's.

#include "runtime/frame/frame_state.h"

namespace blush {

inline bool is_blended(const Face& face, const Primitive& primitive) {
    return primitive.material >= 0 &&
           face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::blend;
}

/// Calls visit(primitive, entry of the draw blocks, mirrored) for every primitive of every node that draws. Of a
/// skinned mesh the surface does not stand in a node: its entry is the last one.
template <class Visit>
void each_drawn_primitive(const CharacterState& character, Visit visit) {
    const Face& face = character.face;
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        const Node& node = face.nodes[n];
        if (node.mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(node.mesh)];
        const std::size_t entry = node.skin >= 0 && character.facts.has_joints ? face.nodes.size() : n;
        const bool mirrored = glm::determinant(glm::dmat3(character.stance.world_from_node[entry])) < 0;
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            if (primitive.index_count != 0) visit(primitive, entry, mirrored);
        }
    }
}

/// Draws a primitive with what is bound, and counts its triangles.
void draw_elements(FrameState& frame, CharacterState& character, const Primitive& primitive);

/// glUseProgram where it is another one than the last; counts the switches.
void use_program(FrameState& frame, const gl::Program& program);
/// After others may have used programs of their own.
void forget_program(FrameState& frame);

/// Writes where every node stands in this view into the draw blocks.
void write_draw_blocks(CharacterState& character);

}  // namespace blush
