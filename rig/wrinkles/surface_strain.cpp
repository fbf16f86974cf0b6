#include "rig/wrinkles/surface_strain.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "rig/deform/rest_frame.h"

namespace blush {
namespace {

struct Eigen2 {
    double least = 0, most = 0;
    glm::dvec2 direction_of_least{1, 0};
};

/// Of the symmetric matrix [[a, b], [b, c]].
Eigen2 eigen(double a, double b, double c) {
    const double mean = 0.5 * (a + c), half = std::hypot(0.5 * (a - c), b);
    // The direction of the larger eigenvalue stands at half the angle of (a - c, 2 b); the smaller is across it.
    const double angle = 0.5 * std::atan2(2 * b, a - c);
    return {mean - half, mean + half, {-std::sin(angle), std::cos(angle)}};
}

}  // namespace

Stretch stretch_of(std::span<const glm::dvec3, 3> rest, std::span<const glm::dvec3, 3> deformed) {
    const glm::dvec3 edge1 = rest[1] - rest[0], edge2 = rest[2] - rest[0];
    const double length1 = glm::length(edge1);
    const glm::dvec3 across = glm::cross(edge1, edge2);
    const double area2 = glm::length(across);
    // Slivers thinner than this are noise of single precision, not skin.
    if (!(area2 > 1e-7 * glm::dot(edge1, edge1)) || !(area2 > 1e-7 * glm::dot(edge2, edge2))) return {};
    const glm::dvec3 x = edge1 / length1, y = glm::cross(across / area2, x);
    // Deformation gradient: the images of x and y.
    const double x2 = glm::dot(edge2, x), y2 = glm::dot(edge2, y);
    const glm::dvec3 moved1 = deformed[1] - deformed[0], moved2 = deformed[2] - deformed[0];
    const glm::dvec3 image_x = moved1 / length1;
    const glm::dvec3 image_y = (moved2 - image_x * x2) / y2;
    const Eigen2 squared = eigen(glm::dot(image_x, image_x), glm::dot(image_x, image_y), glm::dot(image_y, image_y));
    return {std::sqrt(std::max(squared.least, 0.0)), std::sqrt(std::max(squared.most, 0.0)),
            x * squared.direction_of_least.x + y * squared.direction_of_least.y};
}

std::vector<Compression> vertex_compression(const Face& face, std::span<const std::uint32_t> place,
                                            std::span<const glm::vec3> deformed) {
    assert(deformed.size() == face.positions.size() && "one position for each vertex");
    assert(place.size() == face.positions.size() && "one entry of weld() for each vertex");
    std::vector<Compression> sums(place.size(), Compression(0));
    std::vector<double> areas(place.size(), 0);
    for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
        std::array<glm::dvec3, 3> rest, moved;
        for (std::size_t c = 0; c < 3; ++c) {
            rest[c] = glm::dvec3(face.positions[face.indices[i + c]]);
            moved[c] = glm::dvec3(deformed[face.indices[i + c]]);
        }
        const double area = 0.5 * glm::length(glm::cross(rest[1] - rest[0], rest[2] - rest[0]));
        const Stretch stretch = stretch_of(rest, moved);
        Compression tensor(0);
        const glm::dvec3 least = stretch.direction_of_least;
        if (stretch.least < 1) tensor += (1 - stretch.least) * glm::outerProduct(least, least);
        if (stretch.most < 1 && area > 0) {
            const glm::dvec3 normal = glm::normalize(glm::cross(rest[1] - rest[0], rest[2] - rest[0]));
            const glm::dvec3 most = glm::cross(normal, least);
            tensor += (1 - stretch.most) * glm::outerProduct(most, most);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            sums[place[face.indices[i + c]]] += tensor * area;
            areas[place[face.indices[i + c]]] += area;
        }
    }
    std::vector<Compression> result(place.size(), Compression(0));
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (areas[place[v]] > 0) result[v] = sums[place[v]] / areas[place[v]];
    }
    return result;
}

PrincipalCompression principal_compression(const Compression& tensor, glm::dvec3 normal) {
    const glm::dvec3 x(any_perpendicular(glm::vec3(normal)));
    const glm::dvec3 y = glm::cross(normal, x);
    const glm::dvec3 tensor_x = tensor * x, tensor_y = tensor * y;
    const Eigen2 found = eigen(glm::dot(x, tensor_x), glm::dot(x, tensor_y), glm::dot(y, tensor_y));
    const glm::dvec2 across = found.direction_of_least;
    return {std::max(found.most, 0.0), glm::normalize(x * across.y - y * across.x)};
}

}  // namespace blush
