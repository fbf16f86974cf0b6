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

void draw_elements(CharacterState& state, const Primitive& primitive) {
    const std::size_t offset_bytes = std::size_t{primitive.first_index} * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset_bytes));  // NOLINT(performance-no-int-to-ptr): GL's own way
    state.report.triangles_drawn += primitive.index_count / 3;
}

void write_draw_blocks(CharacterState& state) {
    const auto write = [&](std::size_t index, const glm::mat4& world_from_mesh) {
        shared::DrawBlock block{};
        block.world_from_mesh = world_from_mesh;
        block.world_normal_from_mesh = glm::mat4(normal_matrix(world_from_mesh));
        std::memcpy(&state.model.draw_staging[index * state.model.draw_stride], &block, sizeof(block));
    };
    for (std::size_t n = 0; n < state.face.nodes.size(); ++n) write(n, state.world_from_node[n]);
    write(state.face.nodes.size(), glm::mat4(1));
    glNamedBufferSubData(state.model.draw_blocks.name(), 0, static_cast<GLsizeiptr>(state.model.draw_staging.size()),
                         state.model.draw_staging.data());
}

}  // namespace blush
