#pragma once
/// A study of whole frames: what a setting costs, and how far the picture is from that of a reference.

#include <string>
#include <vector>

#include "rig/face.h"
#include "runtime/device.h"
#include "runtime/lighting.h"
#include "runtime/measure/study.h"

namespace blush {

struct FrameStudy {
    std::string setting;              ///< "shadows.size"
    std::vector<std::string> values;  ///< one variant each
    std::size_t default_value = 0;    ///< of values
    std::string reference_value;      ///< the picture that errors are measured against
    const Lighting* lighting = nullptr;
    float nearness = 1;  ///< how many times larger than framed: above 1 for what costs by the pixel of skin
};

/// One study with one character a value, drawn from the front at 192x192 pixels and 4 samples in linear radiance.
/// Errors are over all pixels and channels, in hundredths of the reference's mean. Nothing when the face does not fit
/// the device.
std::vector<Study> frame_study(const Device& device, const Face& face, double millimetres_a_unit,
                               const FrameStudy& what);

/// A strong light behind the head's left and a weak one in front.
const Lighting& study_backlight();

}  // namespace blush
