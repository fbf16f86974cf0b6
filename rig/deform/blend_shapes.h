#pragma once
/// Blend shapes: rest + sum of weight * delta, over the targets whose weight is not zero.
///
/// jimenez-2012, 7.6 and 8.3, applies any number of shapes by repeated stream-out passes. Here a sum over the active
/// targets alone, in ascending order of target, is the definition; every path (this one, stream-out in one pass,
/// stream-out in passes of four) adds in that order and so gives the same bits.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

struct ActiveTarget {
    std::uint32_t target = 0;  ///< index into Face::targets
    float weight = 0;          ///< not zero, finite

    bool operator==(const ActiveTarget&) const = default;
};

/// Replaces `active` by the targets with a non-zero weight, ascending. A weight that is not finite counts as zero.
/// Allocates only when `active` has to grow.
void find_active(std::span<const float> weights, std::vector<ActiveTarget>& active);

/// Adds the active targets to rest attributes that `positions`, `normals` and `tangents` already hold (one entry a
/// vertex of the face). Normals and tangents come out unnormalised.
void add_targets(const Face& face, std::span<const ActiveTarget> active, std::span<Vec3> positions,
                 std::span<Vec3> normals, std::span<Vec4> tangents);

/// Vertices that a SparseBlock covers: one bit each of a 32-bit mask.
inline constexpr std::uint32_t block_vertices = 32;

/// The deltas of one target inside one run of 32 vertices. Vertex 32 * block + lane is moved when bit `lane` of `mask`
/// is set; its delta stands at first_delta + (number of set bits below `lane`).
struct SparseBlock {
    std::uint32_t block = 0;
    std::uint32_t first_delta = 0;  ///< into the concatenated deltas of all targets
    std::uint32_t mask = 0;
};

/// The sparse targets of a face as runs of 32 vertices, so that a vertex finds the targets that move it without looking
/// at those that do not.
struct SparseBlocks {
    explicit SparseBlocks(const Face& face);

    std::vector<SparseBlock> blocks;         ///< by target, then ascending by block
    std::vector<std::uint32_t> first_block;  ///< of each target, and one past the last: targets + 1 entries
    std::vector<std::uint32_t> first_delta;  ///< of each target, and one past the last: targets + 1 entries
    std::uint32_t block_count = 0;           ///< runs of 32 that cover the face
};

/// One active target in one run of vertices, as the stream-out shader reads it.
struct BlockEntry {
    std::uint32_t first_delta = 0;
    std::uint32_t mask = 0;
    std::uint32_t slot = 0;  ///< index into the active targets, where the weight stands
};

/// The active targets of each run: entries of run b are entries[first_entry[b]] up to entries[first_entry[b + 1]], in
/// ascending order of target. Its cost grows with the active targets only, never with the number of targets.
struct BlockLists {
    std::vector<std::uint32_t> first_entry;
    std::vector<BlockEntry> entries;

    /// Only targets with first_target <= target < last_target are listed. Allocates only when a vector has to grow.
    void build(const SparseBlocks& sparse, std::span<const ActiveTarget> active, std::uint32_t first_target,
               std::uint32_t last_target);

private:
    std::vector<std::uint32_t> cursor_;
};

}  // namespace blush
