#include "rig/deform/deform_exact.h"

#include <cmath>

#include "rig/deform/surface_normals.h"

namespace blush {
namespace {

glm::dvec3 angle_weighted(const NormalTopology& topology, const std::vector<glm::dvec3>& positions,
                          std::size_t vertex) {
    glm::dvec3 sum(0);
    for (std::uint32_t i = topology.first_triangle[vertex]; i < topology.first_triangle[vertex + 1]; ++i) {
        const glm::uvec3 triangle = topology.triangles[i];
        const glm::dvec3 a = positions[triangle.x];
        const glm::dvec3 u = positions[triangle.y] - a, v = positions[triangle.z] - a;
        const glm::dvec3 normal = glm::cross(u, v);
        const double sine = glm::length(normal);
        // Where single precision has no direction either (surface_normals.h), the triangle adds nothing.
        constexpr double smallest_sine = 1e-15;
        if (!(sine > smallest_sine * glm::length(u) * glm::length(v))) continue;
        sum += normal * (std::atan2(sine, glm::dot(u, v)) / sine);
    }
    return sum;
}

/// The rest normal turned by the shortest arc between the directions of the two sums, as a rotation matrix.
glm::dvec3 turned(glm::dvec3 rest_normal, glm::dvec3 rest_sum, glm::dvec3 deformed_sum) {
    // Where single precision has no direction either (surface_normals.h), the rest normal is the definition.
    constexpr double smallest_length = 1e-3;
    if (glm::length(rest_sum) <= smallest_length || glm::length(deformed_sum) <= smallest_length) return rest_normal;
    const glm::dvec3 from = glm::normalize(rest_sum), to = glm::normalize(deformed_sum);
    const double c = glm::dot(from, to);
    if (1 + c < 1.5e-6) return to;
    const glm::dvec3 v = glm::cross(from, to);
    const glm::dmat3 skew(0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0);
    return glm::normalize((glm::dmat3(1) + skew + skew * skew * (1 / (1 + c))) * rest_normal);
}

}  // namespace

ExactSurface deform_exact(const Face& face, std::span<const float> weights) {
    ExactSurface surface;
    surface.positions.assign(face.positions.begin(), face.positions.end());
    const std::vector<glm::dvec3> rest = surface.positions;
    for (std::size_t t = 0; t < face.targets.size(); ++t) {
        if (weights[t] == 0) continue;
        const Target& target = face.targets[t];
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            surface.positions[target.vertices[i]] +=
                static_cast<double>(weights[t]) * glm::dvec3(target.position_deltas[i]);
        }
    }

    const NormalTopology topology(face);
    surface.normals.reserve(face.normals.size());
    for (const glm::vec3 normal : face.normals) surface.normals.push_back(glm::normalize(glm::dvec3(normal)));
    for (const Primitive& primitive : face.primitives) {
        if (primitive.normal_source == NormalSource::rest) continue;
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            surface.normals[v] = turned(surface.normals[v], angle_weighted(topology, rest, v),
                                        angle_weighted(topology, surface.positions, v));
        }
    }
    return surface;
}

}  // namespace blush
