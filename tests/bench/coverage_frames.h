#pragma once
/// The oracle's shapes as geometry, drawn by whole frames.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rig/antialias/coverage.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"

namespace blush {

class CoverageFrames {
public:
    /// radiance: of the shapes, before black.
    CoverageFrames(const Device& device, std::vector<CoverageShape> shapes, float radiance);

    /// Settings of a character of its own, and whether the coverage is that of the radiance or of the light shown.
    struct Mode {
        std::vector<std::pair<std::string, std::string>> settings;
        Output output = Output::linear_hdr;
    };
    /// Returns its number. Ends the program with a sentence where a setting does not exist.
    std::size_t add(const Mode& mode);

    /// What a mode makes of a shape, once all samples are there: share of the shape's own light in each pixel.
    /// offset_pixels: moves the samples, x right and y down.
    Grid<double> show(std::size_t mode, std::size_t shape, glm::dvec2 offset_pixels = {});

private:
    struct Drawn {
        Portrait character;
        Output output = Output::linear_hdr;
        double full = 1;  // light of a pixel that is all covered
    };
    Face face() const;
    glm::vec2 corner_of(std::size_t shape) const;
    ViewFrame view_of(std::size_t shape, Output output, glm::dvec2 offset_pixels) const;

    Device device_;
    std::vector<CoverageShape> shapes_;
    float radiance_;
    std::vector<Drawn> drawn_;
    std::vector<Offscreen> offscreens_;  // of each output
};

}  // namespace blush
