#pragma once
/// The inner loops of the vertex path, once for each instruction set: rig/deform/simd/kernel_body.h compiled with other
/// vectors. All give the same bits: every lane does the operations of the scalar loop in its order, none is fused.

#include <cstddef>
#include <cstdint>

#include "rig/deform/vertex_run.h"

namespace blush::simd {

/// The deltas of one target in one tile.
template <class Delta>
struct PieceView {
    const VertexRun* runs = nullptr;
    std::size_t run_count = 0;
    const std::uint16_t* loose = nullptr;  ///< vertices counted from the start of the tile, ascending
    std::size_t loose_count = 0;
    const Delta* run_deltas = nullptr;    ///< of its runs, one after another
    const Delta* loose_deltas = nullptr;  ///< of its loose vertices
};

/// The part of a tile to work on: first <= vertex < last, counted from the start of the tile.
struct TilePart {
    std::uint32_t first = 0, last = 0;
};

struct Kernels {
    /// values[i] += weight * delta for the vertices of `part` that the piece moves. values: the tile's first vertex,
    /// `components` floats a vertex (3 or 4), as deltas have.
    void (*add_floats)(float* values, std::uint32_t components, TilePart part, const PieceView<float>& piece,
                       float weight);
    /// The same with deltas that count in steps: values[i] += weight_of_a_step * delta.
    void (*add_steps)(float* values, std::uint32_t components, TilePart part, const PieceView<std::int16_t>& piece,
                      float weight_of_a_step);
    /// The end of authored normals and tangents, as deform_plain() of rig/deform/deform.h has it. Arrays of `count`
    /// vertices: normals 3 floats each, tangents 4.
    void (*finish_directions)(float* normals, float* tangents, const float* rest_normals, const float* rest_tangents,
                              std::size_t count);
};

extern const Kernels scalar_kernels;
#if defined(__x86_64__)
#define BLUSH_X86 1
extern const Kernels sse2_kernels, avx2_kernels;
#else
#define BLUSH_X86 0
#endif

}  // namespace blush::simd
