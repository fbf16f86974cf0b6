#pragma once
/// The tiles of a picture that have an edge in or beside them, listed on the GPU
/// (shaders/antialias/antialias_tiles.glsl), so that the passes behind it need not be drawn over the rest.

#include <cstdint>

#include "runtime/gl/object.h"

namespace blush {

class EdgeTiles {
public:
    /// Makes the list anew with the compute program that is in use, for edges of this size that were drawn before.
    void list(std::uint32_t width, std::uint32_t height);

    /// Draws four vertices for each tile of the list, as a strip, with the program that is in use.
    void draw() const;

private:
    gl::Buffer buffer_;
    std::uint32_t columns_ = 0, rows_ = 0;
};

}  // namespace blush
