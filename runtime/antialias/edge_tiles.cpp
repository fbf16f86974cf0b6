#include "runtime/antialias/edge_tiles.h"

#include <array>

#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// The fields before the list, as antialias_tiles.glsl has them.
using Head = std::array<GLuint, 6>;

}  // namespace

void EdgeTiles::list(std::uint32_t width, std::uint32_t height) {
    constexpr std::uint32_t side = BLUSH_AA_TILE_PIXELS;
    const std::uint32_t columns = (width + side - 1) / side, rows = (height + side - 1) / side;
    if (columns != columns_ || rows != rows_) {
        buffer_ = gl::make_buffer(sizeof(Head) + sizeof(GLuint) * columns * rows, nullptr, GL_DYNAMIC_STORAGE_BIT);
        columns_ = columns;
        rows_ = rows;
    }
    const Head head = {4, 0, 0, 0, columns, columns * rows};
    glNamedBufferSubData(buffer_.name(), 0, sizeof(Head), head.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_AA_TILES_BINDING, buffer_.name());
    constexpr std::uint32_t invocations = 64;  // of a work group in antialias_tiles.comp
    glDispatchCompute((columns * rows + invocations - 1) / invocations, 1, 1);
}

void EdgeTiles::draw() const {
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_INDIRECT_BUFFER_BINDING, &bound);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_AA_TILES_BINDING, buffer_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer_.name());
    glDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, static_cast<GLuint>(bound));
}

}  // namespace blush
