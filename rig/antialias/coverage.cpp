#include "rig/antialias/coverage.h"

#include <cmath>
#include <numbers>

namespace blush {
namespace {

using glm::dvec2;

double cross(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

/// The part of a convex polygon where dot(p, normal) <= limit (Sutherland and Hodgman 1974).
Polygon clipped(const Polygon& polygon, dvec2 normal, double limit) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        const double before = glm::dot(from, normal) - limit, after = glm::dot(to, normal) - limit;
        if (before <= 0) kept.push_back(from);
        if ((before < 0 && after > 0) || (before > 0 && after < 0)) {
            kept.push_back(glm::mix(from, to, before / (before - after)));
        }
    }
    return kept;
}

double area_of(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return std::abs(twice) / 2;
}

bool contains(const Polygon& polygon, dvec2 p) {
    bool any_left = false, any_right = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const double side = cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]);
        any_left |= side > 0;
        any_right |= side < 0;
    }
    return polygon.size() > 2 && !(any_left && any_right);
}

bool contains(const CoverageShape& shape, dvec2 p) {
    for (const Polygon& polygon : shape.polygons) {
        if (contains(polygon, p)) return true;
    }
    return false;
}

Polygon whole_picture() {
    constexpr double side = coverage_side_pixels;
    return {{0, 0}, {side, 0}, {side, side}, {0, side}};
}

dvec2 direction(double degrees) {
    const double radians = degrees * std::numbers::pi / 180;
    return {std::cos(radians), std::sin(radians)};
}

dvec2 across(dvec2 along) { return {-along.y, along.x}; }

/// A point near the middle of the picture; the offsets fill a pixel evenly (Roberts's sequence of the plastic number).
dvec2 centre(int offset) {
    const dvec2 step(0.7548776662466927, 0.5698402909980532);
    return dvec2(coverage_side_pixels / 2) + glm::fract(0.5 + step * static_cast<double>(offset));
}

}  // namespace

std::vector<CoverageShape> coverage_shapes(const CoverageDensity& density) {
    std::vector<CoverageShape> shapes;
    for (int degrees = 0; degrees <= 90; degrees += density.degrees) {
        for (int offset = 0; offset < density.offsets; ++offset) {
            const dvec2 middle = centre(offset), along = direction(degrees), normal = across(along);
            const double at = glm::dot(middle, normal);
            shapes.push_back({"half planes", {clipped(whole_picture(), normal, at)}, degrees});

            // A wedge of 20 to 160 degrees; its opening turns and changes from shape to shape.
            const dvec2 other = direction(degrees + 20 + (offset * 37 + degrees * 11) % 141);
            const Polygon half = clipped(whole_picture(), -normal, -at);
            shapes.push_back({"wedges", {clipped(half, across(other), glm::dot(middle, across(other)))}, degrees});

            // The corner of a box: upright for half of the shapes, since most boxes on a screen are.
            const dvec2 side = offset % 2 == 0 ? direction(90.0 * (degrees % 4)) : along;
            const Polygon below = clipped(whole_picture(), across(side), glm::dot(middle, across(side)));
            shapes.push_back({"corners", {clipped(below, side, glm::dot(middle, side))}, degrees});

            // Lines 1 to 2 pixels wide.
            const double width = 1 + static_cast<double>(offset) / density.offsets;
            shapes.push_back(
                {"thin lines", {clipped(clipped(whole_picture(), normal, at + width), -normal, -at)}, degrees});
        }
    }
    return shapes;
}

Grid<double> exact_coverage(const CoverageShape& shape) {
    Grid<double> coverage(coverage_side_pixels, coverage_side_pixels);
    for (const Polygon& polygon : shape.polygons) {
        for (int y = 0; y < coverage.height; ++y) {
            const Polygon row = clipped(clipped(polygon, {0, 1}, y + 1), {0, -1}, -y);
            if (row.empty()) continue;
            for (int x = 0; x < coverage.width; ++x) {
                coverage.at(x, y) += area_of(clipped(clipped(row, {1, 0}, x + 1), {-1, 0}, -x));
            }
        }
    }
    return coverage;
}

Pixels sampled(const CoverageShape& shape, dvec2 offset_pixels) {
    Pixels picture(coverage_side_pixels, coverage_side_pixels, {0, 0, 0, 1});
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (contains(shape, dvec2(x + 0.5, y + 0.5) + offset_pixels)) picture.at(x, y) = glm::vec4(1);
        }
    }
    return picture;
}

Grid<double> supersampled(const CoverageShape& shape, int side) {
    Grid<double> mean(coverage_side_pixels, coverage_side_pixels);
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            const dvec2 offset = (dvec2(i, j) + 0.5) / static_cast<double>(side) - 0.5;
            const Pixels samples = sampled(shape, offset);
            for (std::size_t p = 0; p < mean.cells.size(); ++p) {
                mean.cells[p] += static_cast<double>(samples.cells[p].x) / (side * side);
            }
        }
    }
    return mean;
}

void CoverageError::add(const CoverageError& other) {
    sum += other.sum;
    worst = std::max(worst, other.worst);
    contour_pixels += other.contour_pixels;
}

CoverageError coverage_error(const Grid<double>& shown, const Grid<double>& truth) {
    // The middle of the picture: contours go on for as far again on either side, which is the reach of preset high.
    constexpr int margin = coverage_side_pixels / 4;
    CoverageError error;
    for (int y = margin; y < truth.height - margin; ++y) {
        for (int x = margin; x < truth.width - margin; ++x) {
            const double difference = std::abs(shown.at(x, y) - truth.at(x, y));
            error.sum += difference;
            error.worst = std::max(error.worst, difference);
            if (truth.at(x, y) > 1e-9 && truth.at(x, y) < 1 - 1e-9) error.contour_pixels += 1;
        }
    }
    return error;
}

Grid<double> shown_coverage(const Pixels& picture) {
    Grid<double> shown(picture.width, picture.height);
    for (std::size_t p = 0; p < shown.cells.size(); ++p) shown.cells[p] = static_cast<double>(picture.cells[p].x);
    return shown;
}

}  // namespace blush
