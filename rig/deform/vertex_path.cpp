#include "rig/deform/vertex_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "rig/deform/simd/kernels.h"

namespace blush {
namespace {

const simd::Kernels& kernels_of(SimdPath path) {
#if BLUSH_X86
    if (path == SimdPath::avx2) return simd::avx2_kernels;
    if (path == SimdPath::sse2) return simd::sse2_kernels;
#endif
    assert(path == SimdPath::scalar && "VertexPath: this machine does not run that path");
    return simd::scalar_kernels;
}

VertexRange intersection(VertexRange a, VertexRange b) {
    return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// One attribute of one tile while targets are added to it, aligned for vectors whatever the caller's arrays are.
struct Tile {
    alignas(64) std::array<float, std::size_t{tile_vertices} * 4> values;
};

/// The part of an array of vectors that a tile holds, counted from the tile's first vertex.
template <class Vector>
struct TileView {
    const Vector* rest;  ///< the tile's first vertex
    Vector* out;         ///< the same
    simd::TilePart part;

    std::size_t bytes() const { return (part.last - part.first) * sizeof(Vector); }
    float* in(Tile& tile) const { return tile.values.data() + part.first * std::size_t{Vector::length()}; }
    void read(Tile& tile) const { std::memcpy(in(tile), rest + part.first, bytes()); }
    void write(Tile& tile) const { std::memcpy(out + part.first, in(tile), bytes()); }
    void copy() const { std::memcpy(out + part.first, rest + part.first, bytes()); }
};

/// Deltas of a piece as the kernels take them. (A block is eight numbers, and blocks stand one after another.)
simd::PieceView<float> float_view(const PackedAttribute& attribute, const PackedAttribute::Piece& piece) {
    return {attribute.runs.data() + piece.first_run,
            piece.run_count,
            attribute.loose.data() + piece.first_loose,
            piece.loose_count,
            reinterpret_cast<const float*>(attribute.run_floats.data() + piece.first_block),
            attribute.loose_floats.data() + piece.first_loose * attribute.components};
}

simd::PieceView<std::int16_t> step_view(const PackedAttribute& attribute, const PackedAttribute::Piece& piece) {
    return {attribute.runs.data() + piece.first_run,
            piece.run_count,
            attribute.loose.data() + piece.first_loose,
            piece.loose_count,
            reinterpret_cast<const std::int16_t*>(attribute.run_steps.data() + piece.first_block),
            attribute.loose_steps.data() + piece.first_loose * attribute.components};
}

/// Starts reading what the next piece begins with, while this one is added: a stream's first lines are what the
/// processor does not foresee. 4 % on the ICT head with 10 of 57 targets active.
void prefetch(const PackedAttribute& attribute, const PackedAttribute::Piece& piece) {
    const auto line = [](const auto* at) { __builtin_prefetch(at); };
    line(attribute.runs.data() + piece.first_run);
    line(attribute.run_floats.data() + piece.first_block);
    line(attribute.run_floats.data() + piece.first_block + 2);  // 64 bytes on
    line(attribute.loose_floats.data() + piece.first_loose * attribute.components);
}

void add_pieces(const simd::Kernels& kernels, const PackedAttribute& attribute,
                std::span<const ActivePieces::Entry> entries, simd::TilePart part, Tile& tile) {
    float* values = tile.values.data();
    for (std::size_t e = 0; e < entries.size(); ++e) {
        const PackedAttribute::Piece& piece = attribute.pieces[entries[e].piece];
        const float weight = entries[e].weight;
        if (attribute.precision == DeltaPrecision::exact) {
            if (e + 1 < entries.size()) prefetch(attribute, attribute.pieces[entries[e + 1].piece]);
            kernels.add_floats(values, attribute.components, part, float_view(attribute, piece), weight);
        } else {
            kernels.add_steps(values, attribute.components, part, step_view(attribute, piece), weight * piece.step);
        }
    }
}

/// Whether no corner of the triangles around a vertex has moved. Then the angle-weighted normal is that at rest.
bool fan_rests(const NormalTopology& topology, std::span<const glm::vec3> positions, std::span<const glm::vec3> rest,
               std::uint32_t vertex) {
    for (std::uint32_t i = topology.first_triangle[vertex]; i < topology.first_triangle[vertex + 1]; ++i) {
        const glm::uvec3 triangle = topology.triangles[i];
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            if (positions[triangle[corner]] != rest[triangle[corner]]) return false;
        }
    }
    return true;
}

template <class Vector>
void copy(const std::vector<Vector>& from, VertexRange range, std::span<Vector> to) {
    std::copy(from.begin() + range.first, from.begin() + range.last, to.begin() + range.first);
}

}  // namespace

std::string_view name_of(SimdPath path) {
    constexpr std::array<std::string_view, 3> names = {"scalar", "SSE2", "AVX2"};
    return names[static_cast<std::size_t>(path)];
}

std::span<const SimdPath> simd_paths() {
    static constexpr std::array<SimdPath, 3> paths = {SimdPath::scalar, SimdPath::sse2, SimdPath::avx2};
#if BLUSH_X86
    return std::span(paths).first(__builtin_cpu_supports("avx2") ? 3 : 2);  // SSE2 is part of x86-64
#else
    return std::span(paths).first(1);
#endif
}

VertexPath::VertexPath(const Face& face, const PackOptions& options, SimdPath path)
    : face_(face),
      targets_(face, options),
      topology_(face),
      authored_(sections(NormalMethod::authored)),
      recomputed_(sections(NormalMethod::recomputed)),
      path_(path) {}

std::vector<VertexPath::Section> VertexPath::sections(NormalMethod method) const {
    std::vector<const Primitive*> order;
    for (const Primitive& primitive : face_.primitives) order.push_back(&primitive);
    std::ranges::sort(order, {}, [](const Primitive* p) { return std::pair(p->first_vertex, p); });
    std::vector<Section> result;
    std::uint32_t next = 0;
    const auto append = [&](std::uint32_t last, Directions directions) {
        if (last <= next) return;
        if (!result.empty() && result.back().directions == directions) {
            result.back().range.last = last;
        } else {
            result.push_back({{next, last}, directions});
        }
        next = last;
    };
    for (const Primitive* primitive : order) {
        append(primitive->first_vertex, Directions::summed);
        append(primitive->first_vertex + primitive->vertex_count,
               primitive->normal_source == NormalSource::rest ? Directions::summed
               : normals_recomputed(*primitive, method)       ? Directions::turned
                                                              : Directions::finished);
    }
    append(targets_.vertex_count, Directions::summed);
    return result;
}

std::span<const VertexPath::Section> VertexPath::sections_of(NormalMethod method) const {
    return method == NormalMethod::authored ? authored_ : recomputed_;
}

void VertexPath::add_tile(const Job& job, std::uint32_t tile, VertexRange range) const {
    const simd::Kernels& kernels = kernels_of(path_);
    const std::uint32_t first = tile * tile_vertices;
    const auto part_of = [&](VertexRange vertices) {
        return simd::TilePart{vertices.first - first, vertices.last - first};
    };
    Tile sum, tangent_sum;
    const auto add = [&](const auto& view, const PackedAttribute& attribute, const ActivePieces::Lists& lists,
                         Tile& into) {
        view.read(into);
        add_pieces(kernels, attribute, lists.of_tile(tile), view.part, into);
    };

    const TileView<glm::vec3> positions{&face_.positions[first], &job.positions[first], part_of(range)};
    if (job.active->positions.of_tile(tile).empty()) {
        positions.copy();
    } else {
        add(positions, targets_.positions, job.active->positions, sum);
        positions.write(sum);
    }
    if (job.normals.empty()) return;

    const bool still = job.active->normals.of_tile(tile).empty() && job.active->tangents.of_tile(tile).empty();
    for (const Section& section : sections_of(job.method)) {
        const VertexRange range_here = intersection(range, section.range);
        if (range_here.first >= range_here.last || section.directions == Directions::turned) continue;
        const simd::TilePart part = part_of(range_here);
        const TileView<glm::vec3> normals{&face_.normals[first], &job.normals[first], part};
        const TileView<glm::vec4> tangents{&face_.tangents[first], &job.tangents[first], part};
        if (still) {
            normals.copy(), tangents.copy();
            continue;
        }
        add(normals, targets_.normals, job.active->normals, sum);
        add(tangents, targets_.tangents, job.active->tangents, tangent_sum);
        if (section.directions == Directions::finished) {
            kernels.finish_directions(normals.in(sum), tangents.in(tangent_sum), &normals.rest[part.first].x,
                                      &tangents.rest[part.first].x, part.last - part.first);
        }
        normals.write(sum), tangents.write(tangent_sum);
    }
}

void VertexPath::add_targets(std::span<const Job> jobs, VertexRange range) const {
    assert(range.last <= targets_.vertex_count && "VertexPath::add_targets(): the range is outside the face");
    if (range.first >= range.last) return;
    for (std::uint32_t tile = range.first / tile_vertices; tile <= (range.last - 1) / tile_vertices; ++tile) {
        const VertexRange part = intersection(range, {tile * tile_vertices, (tile + 1) * tile_vertices});
        for (const Job& job : jobs) add_tile(job, tile, part);
    }
}

void VertexPath::turn_normals(std::span<const Job> jobs, VertexRange range) const {
    assert(range.last <= targets_.vertex_count && "VertexPath::turn_normals(): the range is outside the face");
    for (const Job& job : jobs) {
        if (job.normals.empty()) continue;
        for (const Section& section : sections_of(job.method)) {
            if (section.directions != Directions::turned) continue;
            const VertexRange part = intersection(range, section.range);
            if (part.first >= part.last) continue;
            copy(face_.normals, part, job.normals);
            copy(face_.tangents, part, job.tangents);
            if (job.active->targets.empty()) continue;
            for (std::uint32_t v = part.first; v < part.last; ++v) {
                if (fan_rests(topology_, job.positions, face_.positions, v)) continue;
                const glm::vec3 rest_normal = face_.normals[v];
                const glm::vec3 normal = turned_normal(rest_normal, topology_.rest_sums[v],
                                                       angle_weighted_normal(topology_, job.positions, v));
                job.normals[v] = normal;
                if (normal == rest_normal) continue;
                job.tangents[v] = orthogonal_tangent(face_.tangents[v], normal, face_.tangents[v]);
            }
        }
    }
}

}  // namespace blush
