#pragma once
/// The oracle of antialiasing: shapes whose share of every pixel is known by analysis.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "rig/antialias/pixels.h"

namespace blush {

/// Convex polygon, corners in order, pixels: x to the right, y down, pixel (0, 0) covers the square from 0 to 1.
using Polygon = std::vector<DVec2>;

struct CoverageShape {
    std::string family;             ///< "half planes", "wedges", "corners", "thin lines"
    std::vector<Polygon> polygons;  ///< do not overlap; white on black
    int degrees = 0;                ///< between a contour of it and the rows
};

inline constexpr int coverage_side_pixels = 64;  ///< of the square picture that the shapes are made for

/// How many shapes of each kind: a step of 1 takes all.
struct CoverageDensity {
    int degrees = 1;   ///< step of the angle, from 0 to 90
    int offsets = 16;  ///< places of the shape within a pixel
};
std::vector<CoverageShape> coverage_shapes(const CoverageDensity& density = {});

/// Area of the shape within each pixel, 0 to 1, by clipping its polygons to the pixel.
Grid<double> exact_coverage(const CoverageShape& shape);

/// What a renderer without antialiasing draws: white where the sample at the pixel's centre plus `offset_pixels` is
/// inside. Linear light, alpha 1.
Pixels sampled(const CoverageShape& shape, DVec2 offset_pixels = {});

/// Mean of side x side samples a pixel, on a regular grid.
Grid<double> supersampled(const CoverageShape& shape, int side);

/// How far pictures of a shape are from the truth. Pixels near the border do not count, since the contour is cut there.
struct CoverageError {
    double sum = 0;             ///< of absolute differences over the pixels that count
    double worst = 0;           ///< greatest of them
    double contour_pixels = 0;  ///< pixels that count and are covered in part

    double mean() const { return contour_pixels > 0 ? sum / contour_pixels : 0; }  ///< a pixel of the contour
    void add(const CoverageError& other);
};
CoverageError coverage_error(const Grid<double>& shown, const Grid<double>& truth);

/// The red channel.
Grid<double> shown_coverage(const Pixels& picture);

}  // namespace blush
