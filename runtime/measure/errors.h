#pragma once
/// Errors of a surface against its exact twin, in units that mean something.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/glm.hpp>

#include "runtime/measure/study.h"

namespace blush {

/// Distances between corresponding points, in millimetres. Both spans have one entry a vertex.
template <class Exact>
Variant::Error distance_error(std::span<const glm::vec3> positions, std::span<const Exact> exact,
                              double millimetres_a_unit) {
    Variant::Error error;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const double distance = glm::length(glm::dvec3(positions[v]) - glm::dvec3(exact[v])) * millimetres_a_unit;
        error.mean += distance / static_cast<double>(positions.size());
        error.worst = std::max(error.worst, distance);
    }
    return error;
}

/// Angles between corresponding unit vectors, in degrees, by the arc tangent: the arc cosine loses half its digits near
/// 0.
inline Variant::Error angle_error(std::span<const glm::vec3> normals, std::span<const glm::dvec3> exact) {
    Variant::Error error;
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const glm::dvec3 n(normals[v]);
        const double radians = std::atan2(glm::length(glm::cross(n, exact[v])), glm::dot(n, exact[v]));
        const double degrees = radians * 180 / std::numbers::pi;
        error.mean += degrees / static_cast<double>(normals.size());
        error.worst = std::max(error.worst, degrees);
    }
    return error;
}

}  // namespace blush
