#include "runtime/files/import/head_assembler.h"

#include <algorithm>
#include <cmath>
#include <future>

namespace blush::load {
namespace {

// A ten-thousandth of a unit vector turns it by 0.006 degrees, far below what shading can show.
constexpr float least_normal_delta = 1e-4F;

using Triangles = std::vector<glm::uvec3>;

Triangles triangles_of(const Polygons& polygons) {
    Triangles triangles;
    for (const Polygons::Polygon& polygon : polygons.polygons) {
        const auto vertex = [&](std::uint32_t c) { return polygons.corners[polygon.first_corner + c].vertex; };
        for (std::uint32_t c = 1; c + 1 < polygon.corner_count; ++c)
            triangles.emplace_back(vertex(0), vertex(c), vertex(c + 1));
    }
    return triangles;
}

/// Angle-weighted (Thuermer and Wuethrich 1998), over the surface's own numbering: vertices that only happen to lie at
/// one place (a lash on a lid) stay apart, unlike in smooth_normals(). A vertex of no triangle gets (0, 0, 1).
std::vector<glm::vec3> normals_of(std::span<const glm::dvec3> positions, const Triangles& triangles) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (const glm::uvec3& triangle : triangles) {
        for (glm::length_t k = 0; k < 3; ++k) {
            const glm::dvec3& here = positions[triangle[k]];
            const glm::dvec3 u = positions[triangle[(k + 1) % 3]] - here, v = positions[triangle[(k + 2) % 3]] - here;
            const glm::dvec3 normal = glm::cross(u, v);
            const double twice_area = glm::length(normal);
            if (twice_area > 0) sums[triangle[k]] += normal * (std::atan2(twice_area, glm::dot(u, v)) / twice_area);
        }
    }
    std::vector<glm::vec3> normals;
    normals.reserve(sums.size());
    for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        normals.push_back(length > 0 && std::isfinite(length) ? glm::vec3(sum / length) : glm::vec3(0, 0, 1));
    }
    return normals;
}

/// Appends what a target does to the vertices of one primitive.
void add_deltas(std::span<const std::uint32_t> sources, std::span<const glm::dvec3> rest,
                std::span<const glm::dvec3> moved, std::span<const glm::vec3> rest_normals,
                std::span<const glm::vec3> moved_normals, double least_delta, std::uint32_t first_vertex,
                Target& target) {
    for (std::uint32_t v = 0; v < sources.size(); ++v) {
        const std::uint32_t source = sources[v];
        const glm::dvec3 delta = moved[source] - rest[source];
        const glm::vec3 turn = moved_normals[source] - rest_normals[source];
        const bool moves = glm::length(delta) >= least_delta, turns = glm::length(turn) >= least_normal_delta;
        if (!moves && !turns) continue;
        target.vertices.push_back(first_vertex + v);
        target.position_deltas.push_back(moves ? glm::vec3(delta) : glm::vec3(0));
        target.normal_deltas.push_back(turns ? turn : glm::vec3(0));
    }
}

}  // namespace

Surface::Surface(Polygons polygons, std::vector<std::vector<glm::dvec3>> targets)
    : polygons_(std::move(polygons)), targets_(std::move(targets)), target_normals_(targets_.size()) {
    const Triangles triangles = triangles_of(polygons_);
    const auto every_second = [&](std::size_t first) {
        for (std::size_t t = first; t < targets_.size(); t += 2) {
            if (!targets_[t].empty()) target_normals_[t] = normals_of(targets_[t], triangles);
        }
    };
    const auto other_half = std::async(std::launch::async, every_second, 1);
    normals_ = normals_of(polygons_.positions, triangles);
    every_second(0);
}

HeadAssembler::HeadAssembler(std::span<const std::string> target_names, double least_delta)
    : least_delta_(least_delta) {
    for (const std::string& name : target_names) face.targets.emplace_back().name = name;
}

void HeadAssembler::add_mesh(const std::string& name, const Surface& surface, std::span<const Piece> pieces,
                             std::int32_t parent) {
    const Polygons& polygons = surface.polygons_;
    const auto first_primitive = static_cast<std::uint32_t>(face.primitives.size());
    for (const Piece& piece : pieces) {
        if (piece.polygons.empty()) continue;
        Primitive primitive;
        primitive.mesh = static_cast<std::uint32_t>(face.meshes.size());
        primitive.material = piece.material;
        primitive.first_vertex = static_cast<std::uint32_t>(face.positions.size());
        primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
        primitive.authored_normals = true;
        primitive.normal_source = NormalSource::authored;

        using Key = std::pair<std::uint32_t, std::uint32_t>;  // vertex, uv
        std::vector<Key> keys;
        const auto key_of = [&](std::uint32_t corner) {
            return Key(polygons.corners[corner].vertex, polygons.corners[corner].uv);
        };
        for (const std::uint32_t p : piece.polygons) {
            const Polygons::Polygon& polygon = polygons.polygons[p];
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) keys.push_back(key_of(polygon.first_corner + c));
        }
        std::ranges::sort(keys);
        keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

        std::vector<std::uint32_t> sources;
        for (const auto& [vertex, uv] : keys) {
            sources.push_back(vertex);
            face.positions.emplace_back(polygons.positions[vertex]);
            face.normals.push_back(surface.normals_[vertex]);
            face.uv0.push_back(uv == Polygons::no_uv ? glm::vec2(0) : polygons.uv[uv]);
        }
        primitive.vertex_count = static_cast<std::uint32_t>(keys.size());

        const auto index_of = [&](std::uint32_t corner) {
            const auto found = std::ranges::lower_bound(keys, key_of(corner));
            return primitive.first_vertex + static_cast<std::uint32_t>(found - keys.begin());
        };
        for (const std::uint32_t p : piece.polygons) {
            const Polygons::Polygon& polygon = polygons.polygons[p];
            for (std::uint32_t c = 1; c + 1 < polygon.corner_count; ++c) {
                for (const std::uint32_t corner : {0U, c, c + 1})
                    face.indices.push_back(index_of(polygon.first_corner + corner));
            }
        }
        primitive.index_count = static_cast<std::uint32_t>(face.indices.size()) - primitive.first_index;
        for (std::size_t t = 0; t < surface.targets_.size(); ++t) {
            if (surface.targets_[t].empty()) continue;
            add_deltas(sources, polygons.positions, surface.targets_[t], surface.normals_, surface.target_normals_[t],
                       least_delta_, primitive.first_vertex, face.targets[t]);
        }
        face.primitives.push_back(primitive);
    }
    face.uv1.resize(face.positions.size(), glm::vec2(0));
    face.tangents.resize(face.positions.size(), glm::vec4(1, 0, 0, 1));
    const auto primitive_count = static_cast<std::uint32_t>(face.primitives.size()) - first_primitive;
    if (primitive_count == 0) return;
    Node& node = face.nodes.emplace_back();
    node.name = name;
    node.parent = parent;
    node.mesh = static_cast<std::int32_t>(face.meshes.size());
    face.meshes.push_back({name, first_primitive, primitive_count});
}

}  // namespace blush::load
