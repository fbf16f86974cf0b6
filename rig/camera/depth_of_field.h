#pragma once
/// A thin lens, and blur by its circles of confusion, in double precision: the twin of shaders/depth_of_field*.frag.

#include <span>
#include <vector>

#include "rig/map.h"
#include "rig/vectors.h"

namespace blush {

struct ThinLens {
    double f_number = 2.8;         ///< above 0
    double focal_length_mm = 50;   ///< above 0
    double focus_mm = 700;         ///< from the lens, above 0; what is nearer than the focal length cannot be focused
    double sensor_height_mm = 24;  ///< above 0
};

/// Radius of the circle of confusion at a depth, in pixels of an image `height` pixels high: scale (1 - focus / depth),
/// below 0 in front of the focus (Potmesil and Chakravarty 1981, 2).
struct BlurRadius {
    double scale_pixels = 0, focus_mm = 1;
    double largest_pixels = 0;  ///< no radius is larger

    /// Rises with the depth, so that it also tells what is in front. depth_mm: above 0, or infinite.
    double at(double depth_mm) const;
};
BlurRadius blur_radius(const ThinLens& lens, double height_pixels, double largest_pixels);

/// Offsets of a gather in units of its radius, the centre first; each stands for the same area (Vogel 1979).
std::vector<Vec2> blur_taps(std::uint32_t count);

/// Gathers what the circles of the pixels around cover. What is behind the focus or in it lies in one layer, and never
/// spreads over what is nearer to it than itself; what is in front lies in another, over the first.
/// tile_pixels: side of the tiles in which the largest radius in front is looked for, at least the largest radius.
Map<DVec3> defocused(const Map<DVec3>& radiance_linear, const Map<float>& radius_pixels, std::span<const Vec2> taps,
                     std::uint32_t tile_pixels);

}  // namespace blush
