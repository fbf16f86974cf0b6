#include "tools/make_face/flatten.h"

#include <Eigen/SparseCholesky>

namespace blush::make_face {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Solver = Eigen::SimplicialLDLT<Matrix>;

/// A triangle in its own plane: corners, and for each corner the cotangent of its angle.
struct Flat {
    std::array<Vec2, 3> corner;
    std::array<double, 3> cotangent;
};

Flat in_its_plane(const Vec3& a, const Vec3& b, const Vec3& c, double scale) {
    const Vec3 ab = (b - a) * scale, ac = (c - a) * scale;
    const double length = std::max(glm::length(ab), 1e-9);
    const Vec3 along = ab / length;
    const double x = glm::dot(ac, along);
    const double y = std::max(glm::length(ac - along * x), 1e-9);
    Flat flat{{Vec2(0), Vec2(length, 0), Vec2(x, y)}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 p = flat.corner[(k + 1) % 3] - flat.corner[k], q = flat.corner[(k + 2) % 3] - flat.corner[k];
        // Clamped, so that slivers neither turn the system indefinite nor rule it.
        flat.cotangent[k] = std::clamp(glm::dot(p, q) / std::abs(p.x * q.y - p.y * q.x), 0.05, 8.0);
    }
    return flat;
}

constexpr double least_scale = 0.75, most_scale = 1.25;

class Flattening {
public:
    Flattening(const FlattenInput& input, std::vector<Vec2> flat) : input_(input), uv_(std::move(flat)) {
        for (std::size_t t = 0; t < input.triangles.size(); ++t) {
            const Triangle& corner = input.triangles[t];
            triangles_.push_back(in_its_plane(input.positions[corner[0]], input.positions[corner[1]],
                                              input.positions[corner[2]], input.scale[t]));
        }
        // Across the fold all of its vertices are held, along it the first one is: else the chart could drift.
        free_[0].resize(uv_.size());
        free_[1].resize(uv_.size());
        bool held = false;
        std::vector<char> used(uv_.size(), 0);
        for (const Triangle& t : input.triangles)
            for (const Index v : t) used[v] = 1;
        for (std::size_t v = 0; v < uv_.size(); ++v) {
            free_[0][v] = used[v] && !input.on_fold[v] ? count_[0]++ : -1;
            const bool hold = !used[v] || (input.on_fold[v] && !held);
            if (used[v] && hold) held = true;
            free_[1][v] = hold ? -1 : count_[1]++;
        }
        for (const int axis : {0, 1}) factorise(axis);
    }

    std::vector<Vec2> run(int rounds) {
        for (int round = 0; round < rounds; ++round) this->round();
        return std::move(uv_);
    }

private:
    /// Calls `edge(corner, a, b, weight)` for the three edges of a triangle; the edge is opposite the corner.
    template <class Edge>
    void each_edge(std::size_t t, Edge edge) const {
        for (std::size_t k = 0; k < 3; ++k) edge((k + 1) % 3, (k + 2) % 3, triangles_[t].cotangent[k]);
    }

    void factorise(int axis) {
        std::vector<Eigen::Triplet<double>> entries;
        const auto a = static_cast<std::size_t>(axis);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            each_edge(t, [&](std::size_t p, std::size_t q, double weight) {
                const int i = free_[a][input_.triangles[t][p]], j = free_[a][input_.triangles[t][q]];
                if (i >= 0) entries.emplace_back(i, i, weight);
                if (j >= 0) entries.emplace_back(j, j, weight);
                if (i >= 0 && j >= 0) {
                    entries.emplace_back(i, j, -weight);
                    entries.emplace_back(j, i, -weight);
                }
            });
        }
        Matrix matrix(count_[a], count_[a]);
        matrix.setFromTriplets(entries.begin(), entries.end());
        solver_[a].compute(matrix);
    }

    void round() {
        std::array<Eigen::VectorXd, 2> right = {Eigen::VectorXd::Zero(count_[0]), Eigen::VectorXd::Zero(count_[1])};
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const Triangle& v = input_.triangles[t];
            // The similarity that fits the triangle best onto where it lies now, its scale held near 1: between the
            // authors' rigid and similar models, so that a nose may shrink a little instead of folding over.
            double c = 0, s = 0, size = 0;
            each_edge(t, [&](std::size_t p, std::size_t q, double weight) {
                const Vec2 from = triangles_[t].corner[p] - triangles_[t].corner[q], to = uv_[v[p]] - uv_[v[q]];
                c += weight * glm::dot(from, to);
                s += weight * (from.x * to.y - from.y * to.x);
                size += weight * glm::dot(from, from);
            });
            const double length = std::max(std::hypot(c, s), 1e-30);
            const double factor = std::clamp(length / size, least_scale, most_scale) / length;
            c *= factor;
            s *= factor;
            each_edge(t, [&](std::size_t p, std::size_t q, double weight) {
                const Vec2 from = triangles_[t].corner[p] - triangles_[t].corner[q];
                const Vec2 wanted(c * from.x - s * from.y, s * from.x + c * from.y);
                for (glm::length_t axis = 0; axis < 2; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    const int i = free_[a][v[p]], j = free_[a][v[q]];
                    if (i >= 0) right[a][i] += weight * (wanted[axis] + (j < 0 ? uv_[v[q]][axis] : 0));
                    if (j >= 0) right[a][j] -= weight * (wanted[axis] - (i < 0 ? uv_[v[p]][axis] : 0));
                }
            });
        }
        for (glm::length_t axis = 0; axis < 2; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Eigen::VectorXd solution = solver_[a].solve(right[a]);
            for (std::size_t v = 0; v < uv_.size(); ++v)
                if (free_[a][v] >= 0) uv_[v][axis] = solution[free_[a][v]];
        }
    }

    const FlattenInput& input_;
    std::vector<Vec2> uv_;
    std::vector<Flat> triangles_;
    std::array<std::vector<int>, 2> free_;  ///< for x and y: the vertex's row in the system, -1 where it is held
    std::array<int, 2> count_{0, 0};
    std::array<Solver, 2> solver_;
};

}  // namespace

std::vector<Vec2> flatten(const FlattenInput& input, std::vector<Vec2> flat) {
    constexpr int rounds = 60;  // nothing moves by a tenth of a millimetre any more
    return Flattening(input, std::move(flat)).run(rounds);
}

}  // namespace blush::make_face
