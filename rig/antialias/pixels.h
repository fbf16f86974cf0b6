#pragma once
/// Plain pictures for the CPU side of the filters: what the passes on the GPU are held to.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "rig/vectors.h"

namespace blush {

/// `width` times `height` of something, rows from the top.
template <class T>
struct Grid {
    int width = 0, height = 0;
    std::vector<T> cells;

    Grid() = default;
    Grid(int columns, int rows, T value = {})
        : width(columns),
          height(rows),
          cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
    T& at(int x, int y) { return cells[index(x, y)]; }
    const T& at(int x, int y) const { return cells[index(x, y)]; }
    /// The nearest cell of the picture.
    const T& clamped(int x, int y) const { return at(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)); }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

using Pixels = Grid<Vec4>;        ///< RGBA, as PictureMeaning says
using DepthPixels = Grid<float>;  ///< window depth
using WeightMap = Grid<U8Vec4>;   ///< near and far of the upper edge, near and far of the left edge, of 255

/// Edges at the left and upper boundary of each pixel. There are none outside the picture, nor on its border.
struct EdgeMap : Grid<U8Vec2> {
    using Grid::Grid;
    bool left(int x, int y) const { return contains(x, y) && at(x, y).x != 0; }
    bool upper(int x, int y) const { return contains(x, y) && at(x, y).y != 0; }
};

}  // namespace blush
