#pragma once
/// How like a measured head the default face is: aligned by a similarity (rotation, translation, one scale), distances
/// of the face region to the other's surface, and how alike two displacement fields are.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace blush::test {

/// A triangle surface that answers "which point is nearest".
class NearestSurface {
public:
    struct Hit {
        std::size_t triangle = 0;
        glm::dvec3 weights{0}, point{0}, normal{0};
        double distance = 0;
    };

    NearestSurface(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> triangles);

    /// The nearest point whose triangle faces the same way as `normal` (a zero normal: any), within `reach`.
    std::optional<Hit> nearest(const glm::dvec3& point, const glm::dvec3& normal, double reach) const;

    const std::vector<glm::uvec3>& triangles() const { return triangles_; }

private:
    std::size_t cell(const glm::ivec3& at) const;
    glm::ivec3 place(const glm::dvec3& point) const;

    std::vector<glm::dvec3> positions_;
    std::vector<glm::uvec3> triangles_;
    glm::dvec3 low_{0};
    glm::ivec3 size_{1};
    std::vector<std::uint32_t> first_, list_;
};

/// to = scale * rotation * from + translation.
struct Similarity {
    glm::dmat3 rotation{1};
    glm::dvec3 translation{0};
    double scale = 1;
    glm::dvec3 operator()(const glm::dvec3& p) const { return scale * (rotation * p) + translation; }
};

/// Least squares over pairs with weights (Umeyama 1991; the rotation by the quaternion of Horn 1987).
Similarity fit_similarity(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                          std::span<const double> weights);

/// A smooth map that takes each landmark to its partner and bends space as little as it can elsewhere: a polyharmonic
/// spline with the kernel r, which is biharmonic in space (Bookstein 1989).
class LandmarkWarp {
public:
    LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);
    glm::dvec3 operator()(const glm::dvec3& p) const;

private:
    std::vector<glm::dvec3> from_, weights_;
    glm::dvec3 constant_{0};
    glm::dmat3 linear_{1};
};

}  // namespace blush::test
