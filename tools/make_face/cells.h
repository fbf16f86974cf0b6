#pragma once
/// Points scattered one a cell of a lattice (Worley, "A cellular texture basis function", 1996).

#include <array>

#include "rig/random.h"
#include "tools/make_face/geometry.h"

namespace blush::make_face {

struct Cell {
    Vec3 point;
    std::array<double, 6> luck;  ///< 0 to 1; the first three placed the point
};

/// Calls `visit(cell)` for the cell of q and its neighbours whose point may lie within half a cell of it.
template <class Visit>
void each_cell(const Vec3& q, Visit visit) {
    // A point keeps off its cell's walls by `margin`: no farther neighbour than the nearest on each axis is needed.
    constexpr double margin = 0.06;
    const Vec3 corner = glm::floor(q), toward = glm::step(Vec3(0.5), q - corner) * 2.0 - 1.0;
    for (int n = 0; n < 8; ++n) {
        const Vec3 c = corner + toward * Vec3(n & 1, n >> 1 & 1, n >> 2 & 1);
        const auto bits = [](double x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)); };
        Random random(bits(c.x) * 0x9e3779b97f4a7c15ULL ^ bits(c.y) * 0xc2b2ae3d27d4eb4fULL ^
                      bits(c.z) * 0x165667b19e3779f9ULL);
        Cell cell;
        for (double& luck : cell.luck) luck = random.unit();
        cell.point = c + margin + (1 - 2 * margin) * Vec3(cell.luck[0], cell.luck[1], cell.luck[2]);
        visit(cell);
    }
}

}  // namespace blush::make_face
