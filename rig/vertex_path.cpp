#include "rig/vertex_path.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "rig/simd/kernels.h"

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

/// Adds the active pieces of one tile to the part of it that `range` holds. values: the tile's first vertex.
void add_pieces(const simd::Kernels& kernels, const PackedAttribute& attribute,
                std::span<const ActivePieces::Entry> entries, simd::TilePart part, float* values) {
    for (const ActivePieces::Entry& entry : entries) {
        const PackedAttribute::Piece& piece = attribute.pieces[entry.piece];
        const VertexRun* runs = attribute.runs.data() + piece.first_run;
        const std::uint16_t* loose = attribute.loose.data() + piece.first_loose;
        if (attribute.shorts.empty()) {
            kernels.add_floats(
                values, attribute.components, part,
                {runs, piece.run_count, loose, piece.loose_count, attribute.floats.data() + piece.first_delta},
                entry.weight);
        } else {
            kernels.add_steps(
                values, attribute.components, part,
                {runs, piece.run_count, loose, piece.loose_count, attribute.shorts.data() + piece.first_delta},
                entry.weight * piece.step);
        }
    }
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
    std::ranges::stable_sort(order, {}, &Primitive::first_vertex);
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
    copy(face_.positions, range, job.positions);
    copy(face_.normals, range, job.normals);
    copy(face_.tangents, range, job.tangents);
    add_pieces(kernels, targets_.positions, job.active->positions.of_tile(tile), part_of(range),
               &job.positions[first].x);

    const auto normal_pieces = job.active->normals.of_tile(tile), tangent_pieces = job.active->tangents.of_tile(tile);
    if (normal_pieces.empty() && tangent_pieces.empty()) return;
    for (const Section& section : sections_of(job.method)) {
        const VertexRange part = intersection(range, section.range);
        if (part.first >= part.last || section.directions == Directions::turned) continue;
        add_pieces(kernels, targets_.normals, normal_pieces, part_of(part), &job.normals[first].x);
        add_pieces(kernels, targets_.tangents, tangent_pieces, part_of(part), &job.tangents[first].x);
        if (section.directions != Directions::finished) continue;
        kernels.finish_directions(&job.normals[part.first].x, &job.tangents[part.first].x, &face_.normals[part.first].x,
                                  &face_.tangents[part.first].x, part.last - part.first);
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
        if (job.active->targets.empty()) continue;
        for (const Section& section : sections_of(job.method)) {
            if (section.directions != Directions::turned) continue;
            const VertexRange part = intersection(range, section.range);
            for (std::uint32_t v = part.first; v < part.last; ++v) {
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
