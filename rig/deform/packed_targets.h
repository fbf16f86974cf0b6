#pragma once
/// The targets of a face, laid out for the CPU's vertex path: any number of faces read one copy.
///
/// Vertices are taken in tiles that stay in the first cache while the active targets are added to them one after
/// another. In a tile, a target's deltas stand as plain floats in the order of the vertices, so that vertices in a row
/// are one long multiply and add. Rows start and end at multiples of eight vertices, so that vectors of eight floats
/// are aligned and nothing remains at the end; vertices in a row that the target leaves alone have deltas of zero. A
/// vertex that would need too many of those stands alone ("loose"), and so does one where a delta of zero next to it
/// could change a bit: -0 + 0 is +0.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "rig/deform/vertex_run.h"
#include "rig/face.h"

namespace blush {

/// Vertices of a tile: 12 kB of positions, beside as much of the deltas of one target, in a first cache of 32 kB.
inline constexpr std::uint32_t tile_vertices = 1024;

enum class DeltaPrecision : std::uint8_t {
    exact,         ///< the file's own floats
    sixteen_bits,  ///< steps of the largest component of the target in the tile / 32767: off by half a step at most
};

/// How targets are packed. The default changes no bit; the others trade error for memory (`blush accuracy`).
struct PackOptions {
    DeltaPrecision precision = DeltaPrecision::exact;
    /// Position deltas not longer than this (mesh units, 0 or more) are left out. Moves a vertex by at most this, times
    /// the sum of the sizes of the active weights. 0: only deltas without effect on any bit are left out.
    float drop_below = 0;
};

/// The packed deltas of one attribute.
struct PackedAttribute {
    /// What one target changes in one tile.
    struct Piece {
        std::uint32_t tile = 0;
        std::uint32_t run_count = 0, loose_count = 0;
        float step = 0;  ///< of sixteen_bits
        std::size_t first_run = 0, first_loose = 0;
        std::size_t first_block = 0;  ///< of the deltas of its runs
    };
    /// Deltas of runs come in blocks of eight numbers.
    struct alignas(32) Floats {
        float values[8];
    };
    struct alignas(16) Shorts {
        std::int16_t values[8];
    };
    DeltaPrecision precision = DeltaPrecision::exact;
    std::uint32_t components = 3;            ///< floats a delta: 3, or 4 for tangents, whose last delta is 0
    std::vector<std::uint32_t> first_piece;  ///< of each target, and one past the last: targets + 1 entries
    std::vector<Piece> pieces;               ///< by target, then ascending by tile
    std::vector<VertexRun> runs;
    std::vector<std::uint16_t> loose;  ///< vertices counted from the start of their tile
    // Either is filled: deltas of the runs, and of the loose vertices (`components` numbers each).
    std::vector<Floats> run_floats;
    std::vector<float> loose_floats;
    std::vector<Shorts> run_steps;
    std::vector<std::int16_t> loose_steps;

    std::size_t bytes() const;
};

struct PackedTargets {
    explicit PackedTargets(const Face& face, const PackOptions& options = {});

    std::uint32_t vertex_count = 0, tile_count = 0;
    PackedAttribute positions, normals, tangents;
    std::size_t dropped = 0;  ///< position deltas left out by PackOptions::drop_below

    std::size_t bytes() const { return positions.bytes() + normals.bytes() + tangents.bytes(); }
};

/// The active pieces of each tile, in ascending order of target: what one face at one moment is made of. Its cost grows
/// with the active targets and the tiles that they touch.
struct ActivePieces {
    struct Entry {
        std::uint32_t piece = 0;
        float weight = 0;
    };
    struct Lists {
        std::vector<std::uint32_t> first_entry;  ///< of each tile, and one past the last: tiles + 1 entries
        std::vector<Entry> entries;

        std::span<const Entry> of_tile(std::uint32_t tile) const {
            return std::span(entries).subspan(first_entry[tile], first_entry[tile + 1] - first_entry[tile]);
        }
    };
    Lists positions, normals, tangents;
    std::vector<ActiveTarget> targets;

    /// weights: one for each target; what is zero or not finite is not active. Allocates only when a vector has to
    /// grow.
    void build(const PackedTargets& packed, std::span<const float> weights);

private:
    std::vector<std::uint32_t> cursor_;
};

}  // namespace blush
