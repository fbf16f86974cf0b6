#include "runtime/draw/draw_face.h"

#include <cstring>

#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// Cofactors of the upper left 3x3: the inverse transpose up to a positive factor, finite for every matrix.
glm::mat3 normal_matrix(const glm::mat4& matrix) {
    const glm::vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(x, cofactors[0]) < 0 ? -cofactors : cofactors;
}

}  // namespace

void draw_elements(FrameState& frame, CharacterState& character, const Primitive& primitive) {
    const std::size_t offset_bytes = std::size_t{primitive.first_index} * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset_bytes));  // NOLINT(performance-no-int-to-ptr): GL's own way
    frame.drew(character, primitive.index_count / 3);
}

void use_program(FrameState& frame, const gl::Program& program) {
    if (frame.program_in_use == program.name()) return;
    glUseProgram(program.name());
    frame.program_in_use = program.name();
    ++frame.report.program_switches;
}

void forget_program(FrameState& frame) { frame.program_in_use = 0; }

void write_draw_blocks(CharacterState& character) {
    DrawBlocks& blocks = character.draw_blocks;
    for (std::size_t n = 0; n < character.shading_from_node.size(); ++n) {
        shared::DrawBlock block{};
        block.world_from_mesh = character.shading_from_node[n];
        block.world_normal_from_mesh = glm::mat4(normal_matrix(character.shading_from_node[n]));
        std::memcpy(&blocks.staging[n * blocks.stride], &block, sizeof(block));
    }
    glNamedBufferSubData(blocks.buffer.name(), 0, static_cast<GLsizeiptr>(blocks.staging.size()),
                         blocks.staging.data());
}

}  // namespace blush
