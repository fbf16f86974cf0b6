#include "rig/head/rigid_fit.h"

#include <array>
#include <cassert>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

namespace blush {
namespace {

using Symmetric = std::array<std::array<double, 4>, 4>;

/// Eigenvector of the largest eigenvalue, by Jacobi's rotations: it stays accurate where eigenvalues lie close.
std::array<double, 4> largest_eigenvector(Symmetric a) {
    Symmetric vectors{};
    for (std::size_t i = 0; i < 4; ++i) vectors[i][i] = 1;
    constexpr int most_sweeps = 16;  // each squares the rest; six are usual
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double off = 0, on = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            on += std::abs(a[i][i]);
            for (std::size_t j = i + 1; j < 4; ++j) off += std::abs(a[i][j]);
        }
        if (!(off > 1e-17 * on)) break;
        for (std::size_t p = 0; p < 4; ++p) {
            for (std::size_t q = p + 1; q < 4; ++q) {
                if (a[p][q] == 0) continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                for (std::size_t k = 0; k < 4; ++k) {
                    const double kp = a[k][p], kq = a[k][q];
                    a[k][p] = c * kp - s * kq;
                    a[k][q] = s * kp + c * kq;
                }
                for (std::size_t k = 0; k < 4; ++k) {
                    const double pk = a[p][k], qk = a[q][k];
                    a[p][k] = c * pk - s * qk;
                    a[q][k] = s * pk + c * qk;
                    const double vp = vectors[k][p], vq = vectors[k][q];
                    vectors[k][p] = c * vp - s * vq;
                    vectors[k][q] = s * vp + c * vq;
                }
            }
        }
    }
    std::size_t best = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (a[i][i] > a[best][best]) best = i;
    }
    return {vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]};
}

}  // namespace

glm::dmat4 fit_rigid(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                     std::span<const double> weights) {
    assert(from.size() == to.size() && from.size() == weights.size());
    glm::dvec3 from_centre(0), to_centre(0);
    double weight = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        from_centre += weights[i] * from[i];
        to_centre += weights[i] * to[i];
        weight += weights[i];
    }
    if (!(weight > 0)) return glm::dmat4(1);
    from_centre /= weight;
    to_centre /= weight;
    glm::dmat3 s(0);  // s[r][c]: sum of from.r * to.c
    for (std::size_t i = 0; i < from.size(); ++i) {
        const glm::dvec3 a = from[i] - from_centre, b = to[i] - to_centre;
        for (glm::length_t r = 0; r < 3; ++r) s[r] += weights[i] * a[r] * b;
    }
    const Symmetric n = {{{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                          {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                          {s[2][0] - s[0][2], s[0][1] + s[1][0], s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
                          {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], s[2][2] - s[0][0] - s[1][1]}}};
    const std::array<double, 4> q = largest_eigenvector(n);
    const glm::dmat3 turn = glm::mat3_cast(glm::dquat(q[0], q[1], q[2], q[3]));
    glm::dmat4 motion(turn);
    motion[3] = glm::dvec4(to_centre - turn * from_centre, 1);
    return motion;
}

}  // namespace blush
