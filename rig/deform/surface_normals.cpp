#include "rig/deform/surface_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "rig/deform/direction_limits.h"

namespace blush {
namespace {

// 1 + cos(179.9 degrees): closer to half a turn than this the axis of the shortest arc is noise.
constexpr float half_turn = 1.5e-6F;

// The squared length of a sum of angles times normals, radians: triangles that face each other (a card with both sides)
// cancel, and leave 1e-7 of an angle as noise.
constexpr float shortest_sum2 = 1e-6F;

float dot3(glm::vec3 a, glm::vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Angle between two unit vectors from the length of their cross product and their dot product, 0 to pi. The arc
/// tangent by Abramowitz and Stegun 4.4.47 (within 1e-5 radians): a weight needs no more, and unlike the library's it
/// is made of operations that round the same on CPU and GPU.
float angle_of(float sine, float cosine) {
    const float size = std::abs(cosine);
    const bool steep = sine > size;
    const float t = steep ? size * (1.0F / sine) : sine * (1.0F / size);
    const float t2 = t * t;
    float angle = t * (0.9998660F + t2 * (-0.3302995F + t2 * (0.1801410F + t2 * (-0.0851330F + t2 * 0.0208351F))));
    if (steep) angle = 1.57079633F - angle;
    return cosine < 0 ? 3.14159265F - angle : angle;
}

// Written out so that the shader's twin (surface_normals.glsl) rounds in the same places.
glm::vec3 cross3(glm::vec3 a, glm::vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Unit normal of the triangle with these two edges, times the angle between them.
glm::vec3 angle_times_normal(glm::vec3 edge, glm::vec3 other_edge) {
    const glm::vec3 u = normalized_or(edge, glm::vec3(0)), v = normalized_or(other_edge, glm::vec3(0));
    const glm::vec3 normal = cross3(u, v);
    const float sine2 = dot3(normal, normal);
    if (!(sine2 > smallest_length2)) return glm::vec3(0);
    const float sine = std::sqrt(sine2);
    return normal * (angle_of(sine, dot3(u, v)) * (1.0F / sine));
}

}  // namespace

bool normals_recomputed(const Primitive& primitive, NormalMethod method) {
    return primitive.normal_source == NormalSource::recomputed ||
           (method == NormalMethod::recomputed && primitive.normal_source == NormalSource::authored);
}

NormalTopology::NormalTopology(const Face& face) {
    const std::size_t count = face.positions.size();

    // Weld: leader[v] is the lowest vertex of v's primitive with the same rest position and normal.
    std::vector<std::uint32_t> leader(count);
    std::iota(leader.begin(), leader.end(), 0U);
    for (const Primitive& primitive : face.primitives) {
        std::vector<std::uint32_t> order(primitive.vertex_count);
        std::iota(order.begin(), order.end(), primitive.first_vertex);
        const auto key = [&](std::uint32_t v) {
            const glm::vec3 p = face.positions[v], n = face.normals[v];
            return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z);
        };
        std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
            return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
        });
        for (std::size_t i = 1; i < order.size(); ++i) {
            if (key(order[i]) == key(order[i - 1])) leader[order[i]] = leader[order[i - 1]];
        }
    }

    // Triangles around each leader, then the same list for each vertex that it leads.
    std::vector<std::uint32_t> fan_size(count, 0);
    for (const std::uint32_t vertex : face.indices) ++fan_size[leader[vertex]];
    first_triangle.resize(count + 1, 0);
    for (std::size_t v = 0; v < count; ++v) first_triangle[v + 1] = first_triangle[v] + fan_size[leader[v]];
    triangles.resize(first_triangle.back());
    std::vector<std::uint32_t> cursor(first_triangle.begin(), first_triangle.end() - 1);
    for (std::size_t corner = 0; corner < face.indices.size(); ++corner) {
        const std::size_t first = corner / 3 * 3;
        const std::uint32_t vertex = face.indices[corner];
        triangles[cursor[leader[vertex]]++] = {vertex, face.indices[first + (corner - first + 1) % 3],
                                               face.indices[first + (corner - first + 2) % 3]};
    }
    for (std::uint32_t v = 0; v < count; ++v) {
        if (leader[v] == v) continue;
        const std::uint32_t from = first_triangle[leader[v]];
        std::copy_n(triangles.begin() + from, fan_size[leader[v]], triangles.begin() + first_triangle[v]);
    }

    rest_sums.reserve(count);
    for (std::uint32_t v = 0; v < count; ++v) rest_sums.push_back(angle_weighted_normal(*this, face.positions, v));
}

glm::vec3 angle_weighted_normal(const NormalTopology& topology, std::span<const glm::vec3> positions,
                                std::uint32_t vertex) {
    glm::vec3 sum(0);
    for (std::uint32_t i = topology.first_triangle[vertex]; i < topology.first_triangle[vertex + 1]; ++i) {
        const glm::uvec3 triangle = topology.triangles[i];
        const glm::vec3 a = positions[triangle.x];
        sum += angle_times_normal(positions[triangle.y] - a, positions[triangle.z] - a);
    }
    return sum;
}

glm::vec3 normalized_or(glm::vec3 v, glm::vec3 fallback) {
    const float length2 = dot3(v, v);
    // Negated so that a NaN takes the fallback too.
    if (!(length2 > smallest_length2 && length2 < largest_length2)) return fallback;
    return v * (1.0F / std::sqrt(length2));
}

glm::vec3 turned_normal(glm::vec3 rest_normal, glm::vec3 rest_sum, glm::vec3 deformed_sum) {
    if (rest_sum == deformed_sum) return rest_normal;
    // Negated so that a NaN keeps the rest normal.
    if (!(dot3(rest_sum, rest_sum) > shortest_sum2 && dot3(deformed_sum, deformed_sum) > shortest_sum2))
        return rest_normal;
    const glm::vec3 from = normalized_or(rest_sum, glm::vec3(0));
    const glm::vec3 to = normalized_or(deformed_sum, glm::vec3(0));
    if (from == glm::vec3(0) || to == glm::vec3(0)) return rest_normal;
    // Rodrigues' formula for the shortest arc, in the form without sine or arc cosine: with v = from x to and
    // c = from . to, R n = c n + v x n + v (v . n) / (1 + c).
    const float c = dot3(from, to);
    if (1.0F + c < half_turn) return to;
    const glm::vec3 v = cross3(from, to);
    const float along = dot3(v, rest_normal) * (1.0F / (1.0F + c));
    return normalized_or(c * rest_normal + cross3(v, rest_normal) + along * v, rest_normal);
}

glm::vec4 orthogonal_tangent(glm::vec4 tangent, glm::vec3 normal, glm::vec4 rest_tangent) {
    const glm::vec3 t(tangent);
    return {normalized_or(t - normal * dot3(normal, t), glm::vec3(rest_tangent)), tangent.w};
}

}  // namespace blush
