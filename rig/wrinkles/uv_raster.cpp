#include "rig/wrinkles/uv_raster.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace blush {
namespace {

using Corners = std::array<glm::dvec2, 3>;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Corners in texels, moved by whole repeats of the texture so that their centre lies in the unit square.
Corners in_texels(const Face& face, std::span<const glm::vec2> uvs, std::size_t triangle, glm::dvec2 size) {
    Corners corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = glm::dvec2(uvs[face.indices[3 * triangle + c]]);
    const glm::dvec2 repeat = glm::floor((corners[0] + corners[1] + corners[2]) / 3.0);
    for (glm::dvec2& corner : corners) corner = (corner - repeat) * size;
    return corners;
}

void cover(UvRaster& raster, std::uint32_t triangle, const Corners& corners) {
    const double area = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!std::isfinite(area) || area == 0) return;
    const auto first = [](double low, std::uint32_t side) {
        return static_cast<std::uint32_t>(std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(side)));
    };
    const auto end = [](double high, std::uint32_t side) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(high - 0.5) + 1, 0.0, static_cast<double>(side)));
    };
    const auto [low_x, high_x] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [low_y, high_y] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    for (std::uint32_t y = first(low_y, raster.height); y < end(high_y, raster.height); ++y) {
        for (std::uint32_t x = first(low_x, raster.width); x < end(high_x, raster.width); ++x) {
            const glm::dvec2 center(x + 0.5, y + 0.5);
            glm::dvec3 weights(cross(corners[1] - center, corners[2] - center),
                               cross(corners[2] - center, corners[0] - center), 0);
            weights /= area;
            weights.z = 1 - weights.x - weights.y;
            // A centre on a shared edge belongs to whichever triangle comes first; none may miss it by rounding.
            constexpr double on_edge = -1e-9;
            if (std::min({weights.x, weights.y, weights.z}) < on_edge) continue;
            UvTexel& texel = raster.texels[std::size_t{y} * raster.width + x];
            const bool inside = std::min({weights.x, weights.y, weights.z}) > -on_edge;
            if (texel.triangle == UvTexel::none) {
                texel = {triangle, glm::vec3(glm::max(weights, glm::dvec3(0)))};
            } else if (inside) {
                ++raster.overlaps;
            }
        }
    }
}

}  // namespace

UvRaster rasterize_uv(const Face& face, std::span<const std::uint8_t> primitives, std::uint32_t uv_set,
                      std::uint32_t width, std::uint32_t height) {
    assert(primitives.size() == face.primitives.size() && "rasterize_uv() takes one entry for each primitive");
    UvRaster raster{width, height, std::vector<UvTexel>(std::size_t{width} * height), 0};
    const std::span<const glm::vec2> uvs = uv_set == 1 ? face.uv1 : face.uv0;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        if (primitives[p] == 0) continue;
        const Primitive& primitive = face.primitives[p];
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count; i += 3) {
            cover(raster, i / 3, in_texels(face, uvs, i / 3, {width, height}));
        }
    }
    return raster;
}

std::vector<std::uint32_t> nearest_covered(const UvRaster& raster) {
    const std::size_t count = raster.texels.size();
    std::vector<std::uint32_t> nearest(count, UvTexel::none);
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
        if (!raster.covered(i)) continue;
        nearest[i] = static_cast<std::uint32_t>(i);
        any = true;
    }
    if (!any) return {};

    const auto width = static_cast<std::int64_t>(raster.width), height = static_cast<std::int64_t>(raster.height);
    const auto distance2 = [&](std::int64_t x, std::int64_t y, std::uint32_t to) {
        const std::int64_t dx = x - to % width, dy = y - to / width;
        return dx * dx + dy * dy;
    };
    const auto take = [&](std::int64_t x, std::int64_t y, std::int64_t from_x, std::int64_t from_y) {
        if (from_x < 0 || from_y < 0 || from_x >= width || from_y >= height) return;
        const std::uint32_t candidate = nearest[static_cast<std::size_t>(from_y * width + from_x)];
        std::uint32_t& own = nearest[static_cast<std::size_t>(y * width + x)];
        if (candidate == UvTexel::none) return;
        if (own == UvTexel::none || distance2(x, y, candidate) < distance2(x, y, own)) own = candidate;
    };
    for (std::int64_t y = 0; y < height; ++y) {
        for (std::int64_t x = 0; x < width; ++x) {
            take(x, y, x, y - 1);
            take(x, y, x - 1, y);
        }
        for (std::int64_t x = width - 1; x >= 0; --x) take(x, y, x + 1, y);
    }
    for (std::int64_t y = height - 1; y >= 0; --y) {
        for (std::int64_t x = width - 1; x >= 0; --x) {
            take(x, y, x, y + 1);
            take(x, y, x + 1, y);
        }
        for (std::int64_t x = 0; x < width; ++x) take(x, y, x - 1, y);
    }
    return nearest;
}

}  // namespace blush
