#include "tools/make_face/mesh.h"

#include <numeric>

namespace blush::make_face {

void Mesh::add_quad(Index a, Index b, Index c, Index d) {
    if (a != b && b != c && a != c) triangles.push_back({a, b, c});
    if (a != c && c != d && a != d) triangles.push_back({a, c, d});
}

std::vector<Vec3> smooth_normals(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                                 std::span<const Index> weld) {
    std::vector<Vec3> sums(positions.size(), Vec3(0));
    for (const Triangle& triangle : triangles) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3& p = positions[triangle[corner]];
            const Vec3 a = positions[triangle[(corner + 1) % 3]] - p, b = positions[triangle[(corner + 2) % 3]] - p;
            const Vec3 normal = glm::cross(a, b);
            const double area = glm::length(normal);
            if (area > 0) sums[weld[triangle[corner]]] += normal / area * std::atan2(area, glm::dot(a, b));
        }
    }
    std::vector<Vec3> normals(positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const Vec3& sum = sums[weld[v]];
        const double length = glm::length(sum);
        normals[v] = length > 0 ? sum / length : Vec3(0, 0, 1);
    }
    return normals;
}

std::vector<Vec3> smooth_normals(const Mesh& mesh) {
    std::vector<Index> own(mesh.positions.size());
    std::iota(own.begin(), own.end(), 0U);
    return smooth_normals(mesh.positions, mesh.triangles, own);
}

std::vector<Index> mirror_across_x(Mesh& mesh, std::span<const char> keep_apart) {
    const auto half = static_cast<Index>(mesh.positions.size());
    std::vector<Index> image(half);
    for (Index v = 0; v < half; ++v) {
        const bool shared = mesh.positions[v].x == 0 && (keep_apart.empty() || !keep_apart[v]);
        image[v] = shared ? v : mesh.add(mirrored(mesh.positions[v]), {1 - mesh.uv[v].x, mesh.uv[v].y});
    }
    image.resize(mesh.positions.size());
    for (Index v = 0; v < half; ++v) image[image[v]] = v;
    const std::size_t count = mesh.triangles.size();
    for (std::size_t t = 0; t < count; ++t) {
        const Triangle triangle = mesh.triangles[t];
        mesh.triangles.push_back({image[triangle[0]], image[triangle[2]], image[triangle[1]]});
    }
    return image;
}

}  // namespace blush::make_face
