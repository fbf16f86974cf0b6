#include "rig/deform/rest_frame.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace blush {
namespace {

/// `sum` at unit length, or `otherwise` where it has no direction. In double precision the square of any float is
/// finite and above zero, so only true zeros are caught.
glm::vec3 unit_or(glm::dvec3 sum, glm::vec3 otherwise) {
    const double largest = std::max({std::abs(sum.x), std::abs(sum.y), std::abs(sum.z)});
    if (!(largest > 0) || !std::isfinite(largest)) return otherwise;
    sum /= largest;
    return glm::vec3(sum / std::sqrt(glm::dot(sum, sum)));
}

}  // namespace

std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 &p = positions[a], &q = positions[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        if (p.z != q.z) return p.z < q.z;
        return a < b;
    });
    std::vector<std::uint32_t> representative(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        representative[order[i]] = same ? representative[order[i - 1]] : order[i];
    }
    return representative;
}

glm::vec3 any_perpendicular(glm::vec3 unit) {
    // The axis furthest from `unit` keeps the cross product away from zero (its length is at least sqrt(2/3)).
    const glm::dvec3 n(unit);
    glm::dvec3 axis(1, 0, 0);
    if (std::abs(n.x) > std::abs(n.y) || std::abs(n.x) > std::abs(n.z)) {
        axis = std::abs(n.y) <= std::abs(n.z) ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    }
    return unit_or(glm::cross(n, axis), glm::vec3(1, 0, 0));
}

std::vector<glm::vec3> smooth_normals(std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles) {
    assert(triangles.size() % 3 == 0 && "smooth_normals: triangles come in threes");
    const std::vector<std::uint32_t> representative = weld(positions);
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const std::uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
        const glm::dvec3 corners[] = {glm::dvec3(positions[a]), glm::dvec3(positions[b]), glm::dvec3(positions[c])};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 u = corners[(k + 1) % 3] - corners[k], v = corners[(k + 2) % 3] - corners[k];
            const glm::dvec3 normal = glm::cross(u, v);
            const double twice_area = glm::length(normal);
            if (!(twice_area > 0) || !std::isfinite(twice_area)) continue;
            sums[representative[triangles[i + k]]] += normal * (std::atan2(twice_area, glm::dot(u, v)) / twice_area);
        }
    }
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit_or(sums[representative[i]], glm::vec3(0, 0, 1));
    return normals;
}

std::vector<glm::vec4> tangents_from_uv(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                        std::span<const glm::vec2> uv, std::span<const std::uint32_t> triangles) {
    assert(normals.size() == positions.size() && uv.size() == positions.size());
    struct Gradient {
        glm::dvec3 u{0}, v{0};
    };
    std::vector<Gradient> sums(positions.size());
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const std::uint32_t corners[] = {triangles[i], triangles[i + 1], triangles[i + 2]};
        const glm::dvec3 edge1 = glm::dvec3(positions[corners[1]]) - glm::dvec3(positions[corners[0]]);
        const glm::dvec3 edge2 = glm::dvec3(positions[corners[2]]) - glm::dvec3(positions[corners[0]]);
        const glm::dvec2 uv1 = glm::dvec2(uv[corners[1]]) - glm::dvec2(uv[corners[0]]);
        const glm::dvec2 uv2 = glm::dvec2(uv[corners[2]]) - glm::dvec2(uv[corners[0]]);
        const double determinant = uv1.x * uv2.y - uv2.x * uv1.y;
        if (determinant == 0 || !std::isfinite(determinant)) continue;
        const double side = determinant > 0 ? 1 : -1;
        const double area = glm::length(glm::cross(edge1, edge2));
        const auto weighted = [&](glm::dvec3 direction) {
            return area * glm::dvec3(unit_or(side * direction, glm::vec3(0)));
        };
        const glm::dvec3 along_u = weighted(edge1 * uv2.y - edge2 * uv1.y);
        const glm::dvec3 along_v = weighted(edge2 * uv1.x - edge1 * uv2.x);
        for (const std::uint32_t corner : corners) {
            sums[corner].u += along_u;
            sums[corner].v += along_v;
        }
    }
    std::vector<glm::vec4> tangents(positions.size());
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        const glm::dvec3 normal(normals[i]);
        const glm::dvec3 in_plane = sums[i].u - normal * glm::dot(normal, sums[i].u);
        // A rounding error of the projection is no direction: the part in the plane must be a real share of the whole.
        const bool has_direction = glm::length(in_plane) > 1e-6 * glm::length(sums[i].u);
        const glm::vec3 perpendicular = any_perpendicular(normals[i]);
        const glm::vec3 tangent = has_direction ? unit_or(in_plane, perpendicular) : perpendicular;
        const bool mirrored = has_direction && glm::dot(glm::cross(normal, glm::dvec3(tangent)), sums[i].v) > 0;
        tangents[i] = glm::vec4(tangent, mirrored ? -1.0F : 1.0F);
    }
    return tangents;
}

}  // namespace blush
