#pragma once
/// Map<T>: a picture of plain values, such as the concentration of hemoglobin over a face's texture.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rig/vectors.h"

namespace blush {

/// Rows from the top, as in Image. Texel (x, y) covers texture coordinates from x / width to (x + 1) / width.
template <class T>
struct Map {
    std::uint32_t width = 0, height = 0;
    std::vector<T> values;  ///< width * height

    Map() = default;
    Map(std::uint32_t w, std::uint32_t h, T value = T{}) : width(w), height(h), values(std::size_t{w} * h, value) {}

    T& at(std::uint32_t x, std::uint32_t y) { return values[std::size_t{y} * width + x]; }
    const T& at(std::uint32_t x, std::uint32_t y) const { return values[std::size_t{y} * width + x]; }
    bool same_size(const auto& other) const { return width == other.width && height == other.height; }
};

using ScalarMap = Map<float>;
using ColourMap = Map<Vec3>;

/// Bilinear, between texel centres, clamped at the edges; uv in 0 to 1. The map has one texel at least.
float sample(const ScalarMap& map, Vec2 uv);
Vec3 sample(const ColourMap& map, Vec2 uv);

/// The map at another size: each new texel is the mean of the area that it covers (also of parts of texels). A larger
/// size repeats texels; sample() is there for smooth enlargement. Sizes: 1 or more.
ScalarMap resized(const ScalarMap& map, std::uint32_t width, std::uint32_t height);
ColourMap resized(const ColourMap& map, std::uint32_t width, std::uint32_t height);
/// The same with every texel weighted; where an area has no weight at all, the mean without weights.
ScalarMap resized(const ScalarMap& map, const ScalarMap& weights, std::uint32_t width, std::uint32_t height);

}  // namespace blush
