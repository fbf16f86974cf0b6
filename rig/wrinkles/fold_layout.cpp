#include "rig/wrinkles/fold_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "rig/wrinkles/wrinkle_zones.h"

namespace blush {
namespace {

/// How far skin may lie behind other skin and still show: less than a cheek's thickness, more than the steepest side of
/// a nose rises in a cell.
constexpr float hidden_mm = 6, cell_mm = 2;

/// The outermost skin at each place of the mean face.
class Outermost {
public:
    Outermost() : radius_mm_(std::size_t{columns} * rows, 0.0F) {}

    void add(const std::array<glm::vec2, 3>& mm, const std::array<float, 3>& radius) {
        glm::vec2 low = glm::min(mm[0], glm::min(mm[1], mm[2])), high = glm::max(mm[0], glm::max(mm[1], mm[2]));
        // Behind the head, where x jumps, lies no zone.
        if (high.x - low.x > CanonicalFrame::turn_mm() / 2) return;
        const glm::vec2 border = cell_mm * glm::vec2(columns, rows) / 2.0F;
        low = glm::max(low, -border);
        high = glm::min(high, border);
        for (std::size_t c = 0; c < 3; ++c) put(mm[c], radius[c]);
        const glm::vec2 a = mm[1] - mm[0], b = mm[2] - mm[0];
        const float area = a.x * b.y - a.y * b.x;
        if (!std::isfinite(area) || area == 0) return;
        for (float y = std::floor(low.y / cell_mm) * cell_mm; y <= high.y; y += cell_mm) {
            for (float x = std::floor(low.x / cell_mm) * cell_mm; x <= high.x; x += cell_mm) {
                const glm::vec2 off = glm::vec2(x, y) + cell_mm / 2 - mm[0];
                const float s = (off.x * b.y - off.y * b.x) / area, t = (a.x * off.y - a.y * off.x) / area;
                if (s < 0 || t < 0 || s + t > 1) continue;
                put(mm[0] + off, (1 - s - t) * radius[0] + s * radius[1] + t * radius[2]);
            }
        }
    }
    float at(glm::vec2 mm) const {
        const std::ptrdiff_t cell = cell_of(mm);
        return cell < 0 ? 0 : radius_mm_[static_cast<std::size_t>(cell)];
    }

private:
    static constexpr int columns = 300, rows = 300;
    static std::ptrdiff_t cell_of(glm::vec2 mm) {
        const glm::vec2 cell = glm::floor(mm / cell_mm) + glm::vec2(columns, rows) / 2.0F;
        if (!(cell.x >= 0 && cell.x < columns && cell.y >= 0 && cell.y < rows)) return -1;
        return static_cast<std::ptrdiff_t>(cell.y) * columns + static_cast<std::ptrdiff_t>(cell.x);
    }
    void put(glm::vec2 mm, float radius) {
        const std::ptrdiff_t cell = cell_of(mm);
        if (cell < 0) return;
        float& most = radius_mm_[static_cast<std::size_t>(cell)];
        most = std::max(most, radius);
    }
    std::vector<float> radius_mm_;
};

/// Triangles of zones in the layout, in cells, so that a few that are the rim of something else (the inside of a lip)
/// can be told from where skin folds.
class Islands {
public:
    Islands() : cells_(std::size_t{side} * side) {}

    void add(const std::array<glm::vec2, 3>& uv) {
        const glm::vec2 middle = (uv[0] + uv[1] + uv[2]) / 3.0F * static_cast<float>(side);
        const int x = std::min(static_cast<int>(middle.x), side - 1),
                  y = std::min(static_cast<int>(middle.y), side - 1);
        Box& cell = cells_[static_cast<std::size_t>(y * side + x)];
        for (const glm::vec2& corner : uv) {
            cell.low = glm::min(cell.low, corner);
            cell.high = glm::max(cell.high, corner);
        }
        ++cell.triangles;
        ++triangles_;
    }
    /// Of all islands that hold a hundredth of the triangles or more.
    std::pair<glm::vec2, glm::vec2> bounds() {
        Box all;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            if (cells_[i].triangles == 0) continue;
            const Box island = take_island(i);
            if (100 * island.triangles < triangles_) continue;
            all.low = glm::min(all.low, island.low);
            all.high = glm::max(all.high, island.high);
        }
        return {all.low, all.high};
    }

private:
    static constexpr int side = 64, reach = 2;  // cells; islands are farther apart than `reach`
    struct Box {
        glm::vec2 low{2}, high{-1};
        std::size_t triangles = 0;
    };
    Box take_island(std::size_t first) {
        Box island;
        std::vector<std::size_t> edge = {first};
        while (!edge.empty()) {
            const auto at = static_cast<int>(edge.back());
            Box cell;
            std::swap(cell, cells_[edge.back()]);
            edge.pop_back();
            island.low = glm::min(island.low, cell.low);
            island.high = glm::max(island.high, cell.high);
            island.triangles += cell.triangles;
            for (int y = std::max(at / side - reach, 0); y <= std::min(at / side + reach, side - 1); ++y) {
                for (int x = std::max(at % side - reach, 0); x <= std::min(at % side + reach, side - 1); ++x) {
                    const auto other = static_cast<std::size_t>(y * side + x);
                    if (cells_[other].triangles > 0) edge.push_back(other);
                }
            }
        }
        return island;
    }
    std::vector<Box> cells_;
    std::size_t triangles_ = 0;
};

template <class Do>
void each_triangle(const Face& face, std::span<const std::uint32_t> primitives, Do&& run) {
    for (const std::uint32_t p : primitives) {
        const Primitive& primitive = face.primitives[p];
        for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3) run((primitive.first_index + i) / 3);
    }
}

}  // namespace

std::vector<std::uint8_t> outer_triangles(const Face& face, std::span<const std::uint32_t> primitives,
                                          const CanonicalFrame& frame) {
    Outermost outermost;
    const auto corners = [&](std::uint32_t triangle, auto of) {
        const std::uint32_t* const index = &face.indices[std::size_t{triangle} * 3];
        return std::array{of(face.positions[index[0]]), of(face.positions[index[1]]), of(face.positions[index[2]])};
    };
    const auto place = [&](const glm::vec3& position) { return frame.canonical_mm(position); };
    const auto radius = [&](const glm::vec3& position) { return frame.radius_mm(position); };
    each_triangle(face, primitives,
                  [&](std::uint32_t triangle) { outermost.add(corners(triangle, place), corners(triangle, radius)); });
    std::vector<std::uint8_t> outer(face.indices.size() / 3, 0);
    each_triangle(face, primitives, [&](std::uint32_t triangle) {
        const auto at = corners(triangle, [](const glm::vec3& position) { return position; });
        const glm::vec3 middle = (at[0] + at[1] + at[2]) / 3.0F, first = at[1] - at[0];
        const glm::vec3 normal = glm::cross(first, at[2] - at[0]);
        // A step along the normal, as long as the triangle: the lining of lips and cheeks faces the axis.
        const float size = std::sqrt(glm::length(normal));
        const glm::vec3 step = size > 0 ? normal / size : glm::vec3(0);
        const bool outwards = radius(middle + step) > radius(middle);
        outer[triangle] = outwards && radius(middle) > outermost.at(place(middle)) - hidden_mm ? 1 : 0;
    });
    return outer;
}

LayoutPart part_of_zones(const Face& face, std::span<const std::uint8_t> triangles, const CanonicalFrame& frame,
                         std::span<const std::string> zones) {
    const auto known = [](const std::string& zone) {
        return std::ranges::find(wrinkle_zone_places, zone, &WrinkleZonePlace::name) != wrinkle_zone_places.end();
    };
    if (face.uv0.empty() || !std::ranges::all_of(zones, known)) return {};
    Islands islands;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (triangles[t] == 0) continue;
        const std::uint32_t* const index = &face.indices[3 * t];
        std::array<glm::vec2, 3> uv;
        bool reached = false;
        for (std::size_t c = 0; c < 3; ++c) {
            uv[c] = face.uv0[index[c]];
            if (!(uv[c].x >= 0 && uv[c].x <= 1 && uv[c].y >= 0 && uv[c].y <= 1)) return {};
            reached = reached || in_a_zone(zones, frame.canonical_mm(face.positions[index[c]]));
        }
        if (reached) islands.add(uv);
    }
    const auto [low, high] = islands.bounds();
    if (!(low.x < high.x && low.y < high.y)) return {};
    // Two texels of a mask of 64, so that masks end before the part does.
    constexpr float margin = 2.0F / 64, least_gain = 0.7F;
    const glm::vec2 border = margin * (high - low);
    const LayoutPart part{glm::max(low - border, glm::vec2(0)), glm::min(high + border, glm::vec2(1))};
    const glm::vec2 size = part.to - part.from;
    return size.x * size.y < least_gain ? part : LayoutPart{};
}

Face cropped(const Face& face, std::span<const std::uint8_t> triangles, const LayoutPart& part) {
    Face result = face;
    result.images.clear();
    for (glm::vec2& uv : result.uv0) uv = part.within(uv);
    result.indices.clear();
    for (Primitive& primitive : result.primitives) {
        const std::uint32_t first = primitive.first_index / 3, end = first + primitive.index_count / 3;
        primitive.first_index = static_cast<std::uint32_t>(result.indices.size());
        for (std::uint32_t t = first; t < end; ++t) {
            if (triangles[t] == 0) continue;
            const std::uint32_t* const index = &face.indices[std::size_t{t} * 3];
            const glm::vec2 middle = (result.uv0[index[0]] + result.uv0[index[1]] + result.uv0[index[2]]) / 3.0F;
            if (!part.is_whole() && !(middle.x >= 0 && middle.x < 1 && middle.y >= 0 && middle.y < 1)) continue;
            result.indices.insert(result.indices.end(), index, index + 3);
        }
        primitive.index_count = static_cast<std::uint32_t>(result.indices.size()) - primitive.first_index;
    }
    return result;
}

}  // namespace blush
