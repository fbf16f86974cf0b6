#pragma once
/// What ways to sample a frame cost and how far from the reference they are.

#include <span>
#include <string_view>
#include <vector>

#include "rig/face.h"
#include "runtime/device.h"
#include "runtime/measure/study.h"

namespace blush {

struct StudiedMode {
    std::string_view label, work;
    std::string_view mode;                       ///< of antialiasing.mode
    std::string_view setting = {}, choice = {};  ///< one more, where the mode does not say all
    int frames = 1;                              ///< of the same scene, until the picture is complete
    bool is_default = false;
};

/// One study: a face with its first targets active, 256x256, from the front; errors of display values against the mean
/// of 64 pictures, over all pixels.
std::vector<Study> antialiasing_studies(const Device& device, const Face& face, std::span<const StudiedMode> modes);

}  // namespace blush
