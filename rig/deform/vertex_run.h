#pragma once
/// Vertices in a row. A file of its own, without any library: the SIMD kernels read it too
/// (rig/deform/simd/kernel_body.h).

#include <cstdint>

namespace blush {

/// Vertices in a row that a target moves, counted from the start of a tile (rig/deform/packed_targets.h).
struct VertexRun {
    std::uint16_t first = 0, count = 0;
};

}  // namespace blush
