#pragma once
/// Pictures that the studies of the camera's effects compare, in double precision.

#include <memory>
#include <string>
#include <vector>

#include "rig/map.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/study.h"
#include "runtime/offscreen.h"

namespace blush {

using ExactPicture = Map<glm::dvec3>;

/// A face, a picture of it, and what settings make of it.
struct PicturedFace {
    static constexpr std::uint32_t side_pixels = 192;

    Portrait character;
    Offscreen offscreen;
    ViewFrame view;

    /// Complete when it returns.
    void draw();
    /// Draws. Rows from the bottom, as passes see them; of an 8-bit picture 0 to 1.
    ExactPicture picture();
};

struct NamedValue {
    std::string setting, value;
};
/// From the front. Null where the face does not fit the device.
std::shared_ptr<PicturedFace> pictured(const Device& device, const Face& face, double millimetres_a_unit, Output output,
                                       const std::vector<NamedValue>& settings);

/// Over all pixels and channels, in hundredths of the reference's mean.
Variant::Error percent_of_mean(const ExactPicture& picture, const ExactPicture& reference);

}  // namespace blush
