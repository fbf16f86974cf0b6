#pragma once
/// The CPU's vertex path: blend shapes for one face or a crowd, on as many threads as the caller has.
///
/// The same sum as everywhere (rig/deform/blend_shapes.h): ascending by target, one rounding a multiplication and one
/// an addition, none fused. A vertex's value depends on its own deltas and weights alone, so the bits are those of
/// deform_plain() and of the GPU on every instruction set, for every split into ranges and every batch of faces.
///
///     VertexPath path(face);                        // once; immutable, read by any number of threads
///     ActivePieces active;                          // one a face of the crowd
///     active.build(path.targets(), pose.weights);   // each frame
///     path.add_targets(jobs, range);                // each range once, on any thread; out is written, never read
///     path.turn_normals(jobs, range);               // the same, after add_targets() has done every range
///
/// Nothing here allocates or starts a thread; a caller that has threads gives each its ranges (or its faces).

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rig/deform/packed_targets.h"
#include "rig/deform/surface_normals.h"
#include "rig/face.h"

namespace blush {

enum class SimdPath : std::uint8_t { scalar, sse2, avx2 };

std::string_view name_of(SimdPath path);
/// The paths that this machine runs, slowest first: scalar on every machine.
std::span<const SimdPath> simd_paths();

/// first <= vertex < last.
struct VertexRange {
    std::uint32_t first = 0, last = 0;
};

class VertexPath {
public:
    /// One face of a crowd: its active targets, and where its deformed attributes go (one entry a vertex each). Normals
    /// and tangents may both be left empty where positions are all that is wanted.
    struct Job {
        const ActivePieces* active = nullptr;
        NormalMethod method = NormalMethod::authored;
        std::span<Vec3> positions, normals;
        std::span<Vec4> tangents;
    };

    /// Keeps a reference to `face`, which must outlive it. Packs the targets and builds the topology of the normals.
    explicit VertexPath(const Face& face, const PackOptions& options = {}, SimdPath path = simd_paths().back());

    const PackedTargets& targets() const { return targets_; }
    const NormalTopology& topology() const { return topology_; }
    VertexRange all_vertices() const { return {0, targets_.vertex_count}; }

    /// Writes positions of the range, and its normals and tangents where they come from the targets' own deltas. Tile
    /// by tile, and in each tile face by face, so that a crowd reads the deltas from memory once.
    void add_targets(std::span<const Job> jobs, VertexRange range) const;

    /// Writes normals and tangents of the range where they turn with the surface (normals_recomputed()). Reads the
    /// positions around the range.
    void turn_normals(std::span<const Job> jobs, VertexRange range) const;

private:
    enum class Directions : std::uint8_t { summed, finished, turned };
    /// Vertices in a row whose normals are made alike.
    struct Section {
        VertexRange range;
        Directions directions;
    };
    std::vector<Section> sections(NormalMethod method) const;
    std::span<const Section> sections_of(NormalMethod method) const;
    void add_tile(const Job& job, std::uint32_t tile, VertexRange range) const;

    const Face& face_;
    PackedTargets targets_;
    NormalTopology topology_;
    std::vector<Section> authored_, recomputed_;
    SimdPath path_;
};

}  // namespace blush
