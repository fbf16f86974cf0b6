#include "tests/make_face/likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace blush::test {
namespace {

constexpr double cell_mm = 6;

/// Barycentric weights of the point of a triangle nearest to p (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
glm::dvec3 nearest_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                 d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double t = (d4 - d3) / (d4 - d3 + d5 - d6);
        return {0, 1 - t, t};
    }
    const double sum = va + vb + vc;
    return sum > 0 ? glm::dvec3(va, vb, vc) / sum : glm::dvec3(1, 0, 0);
}

/// Solves A X = B by Gauss elimination with partial pivoting; A is n by n, B n by 3.
std::vector<glm::dvec3> solve(std::vector<std::vector<double>> a, std::vector<glm::dvec3> b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
        std::swap(a[k], a[pivot]);
        std::swap(b[k], b[pivot]);
        for (std::size_t i = k + 1; i < n; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

}  // namespace

NearestSurface::NearestSurface(std::vector<glm::dvec3> positions, std::vector<glm::uvec3> triangles)
    : positions_(std::move(positions)), triangles_(std::move(triangles)) {
    glm::dvec3 high(-1e30);
    low_ = glm::dvec3(1e30);
    for (const glm::uvec3& t : triangles_) {
        for (glm::length_t k = 0; k < 3; ++k) {
            low_ = glm::min(low_, positions_[t[k]]);
            high = glm::max(high, positions_[t[k]]);
        }
    }
    size_ = glm::ivec3((high - low_) / cell_mm) + 1;
    const auto each_cell = [&](const glm::uvec3& t, auto visit) {
        const glm::dvec3 &a = positions_[t.x], &b = positions_[t.y], &c = positions_[t.z];
        const glm::ivec3 from = place(glm::min(a, glm::min(b, c))), to = place(glm::max(a, glm::max(b, c)));
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x) visit(cell({x, y, z}));
    };
    first_.assign(
        static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(size_.z) + 1,
        0);
    for (const glm::uvec3& t : triangles_) each_cell(t, [&](std::size_t c) { ++first_[c + 1]; });
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    list_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        each_cell(triangles_[i], [&](std::size_t c) { list_[next[c]++] = i; });
}

glm::ivec3 NearestSurface::place(const glm::dvec3& point) const {
    return glm::clamp(glm::ivec3(glm::floor((point - low_) / cell_mm)), glm::ivec3(0), size_ - 1);
}

std::size_t NearestSurface::cell(const glm::ivec3& at) const {
    return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(at.y)) *
               static_cast<std::size_t>(size_.x) +
           static_cast<std::size_t>(at.x);
}

std::optional<NearestSurface::Hit> NearestSurface::nearest(const glm::dvec3& point, const glm::dvec3& normal,
                                                           double reach) const {
    std::optional<Hit> best;
    double best_distance = reach;
    const glm::ivec3 centre = place(point);
    const int rings = static_cast<int>(reach / cell_mm) + 1;
    for (int ring = 0; ring <= rings; ++ring) {
        // A cell of this ring is at least ring - 1 cells away.
        if (best && best_distance < (ring - 1) * cell_mm) break;
        for (int z = -ring; z <= ring; ++z) {
            for (int y = -ring; y <= ring; ++y) {
                const bool inside = std::abs(z) < ring && std::abs(y) < ring;
                for (int x = -ring; x <= ring; x += inside && ring > 0 ? 2 * ring : 1) {
                    const glm::ivec3 at = centre + glm::ivec3(x, y, z);
                    if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, size_)))
                        continue;
                    const std::size_t c = cell(at);
                    for (std::uint32_t n = first_[c]; n < first_[c + 1]; ++n) {
                        const glm::uvec3& t = triangles_[list_[n]];
                        const glm::dvec3 &a = positions_[t.x], &b = positions_[t.y], &d = positions_[t.z];
                        const glm::dvec3 face = glm::cross(b - a, d - a);
                        if (normal != glm::dvec3(0) && glm::dot(face, normal) <= 0) continue;
                        const glm::dvec3 w = nearest_weights(point, a, b, d);
                        const glm::dvec3 q = w.x * a + w.y * b + w.z * d;
                        const double distance = glm::distance(point, q);
                        if (distance >= best_distance) continue;
                        best_distance = distance;
                        const double length = glm::length(face);
                        best = Hit{list_[n], w, q, length > 0 ? face / length : glm::dvec3(0), distance};
                    }
                }
            }
        }
    }
    return best;
}

Similarity fit_similarity(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to,
                          std::span<const double> weights) {
    double total = 0;
    glm::dvec3 mean_from(0), mean_to(0);
    for (std::size_t i = 0; i < from.size(); ++i) {
        total += weights[i];
        mean_from += weights[i] * from[i];
        mean_to += weights[i] * to[i];
    }
    mean_from /= total;
    mean_to /= total;
    double s[3][3] = {}, spread = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const glm::dvec3 a = from[i] - mean_from, b = to[i] - mean_to;
        spread += weights[i] * glm::dot(a, a);
        for (glm::length_t r = 0; r < 3; ++r)
            for (glm::length_t c = 0; c < 3; ++c) s[r][c] += weights[i] * a[r] * b[c];
    }
    // Horn 1987, equation of section 4.A: the rotation is the eigenvector of the largest eigenvalue.
    const double n[4][4] = {{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
                            {s[1][2] - s[2][1], s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
                            {s[2][0] - s[0][2], s[0][1] + s[1][0], -s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
                            {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], -s[0][0] - s[1][1] + s[2][2]}};
    double shift = 0;
    for (const auto& row : n)
        for (const double x : row) shift += std::abs(x);
    std::array<double, 4> q{1, 0, 0, 0};
    for (int round = 0; round < 2000; ++round) {  // power iteration; the shift makes the largest the dominant one
        std::array<double, 4> next{};
        double length = 0;
        for (std::size_t r = 0; r < 4; ++r) {
            next[r] = shift * q[r];
            for (std::size_t c = 0; c < 4; ++c) next[r] += n[r][c] * q[c];
            length += next[r] * next[r];
        }
        for (double& x : next) x /= std::sqrt(length);
        q = next;
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    Similarity fit;
    fit.rotation = glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),  // columns
                              2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),  //
                              2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
    double along = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        along += weights[i] * glm::dot(fit.rotation * (from[i] - mean_from), to[i] - mean_to);
    fit.scale = along / spread;
    fit.translation = mean_to - fit.scale * (fit.rotation * mean_from);
    return fit;
}

LandmarkWarp::LandmarkWarp(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to)
    : from_(from.begin(), from.end()) {
    const std::size_t n = from.size();
    std::vector<std::vector<double>> a(n + 4, std::vector<double>(n + 4, 0));
    std::vector<glm::dvec3> b(n + 4, glm::dvec3(0));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) a[i][j] = glm::distance(from[i], from[j]);
        const double affine[] = {1, from[i].x, from[i].y, from[i].z};
        for (std::size_t k = 0; k < 4; ++k) a[i][n + k] = a[n + k][i] = affine[k];
        b[i] = to[i];
    }
    const std::vector<glm::dvec3> solution = solve(std::move(a), std::move(b));
    weights_.assign(solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(n));
    constant_ = solution[n];
    linear_ = glm::dmat3(solution[n + 1], solution[n + 2], solution[n + 3]);
}

glm::dvec3 LandmarkWarp::operator()(const glm::dvec3& p) const {
    glm::dvec3 sum = constant_ + linear_ * p;
    for (std::size_t i = 0; i < from_.size(); ++i) sum += weights_[i] * glm::distance(p, from_[i]);
    return sum;
}

}  // namespace blush::test
