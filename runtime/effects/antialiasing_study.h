#pragma once
/// What ways to sample a frame cost and how far from the reference they are.

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/effect.h"

namespace blush {

struct StudiedMode {
    std::string_view label, work;
    std::array<std::pair<std::string_view, std::string_view>, 2> settings{};  ///< name and choice; empty: none
    int frames = 1;  ///< of the same scene, until the picture is complete
    bool is_default = false;
};

/// One study: a face with its first targets active, 256x256, from the front; errors of display values against the mean
/// of 64 pictures, over the pixels that differ from it in any mode studied (elsewhere there is nothing to smooth).
std::vector<Study> antialiasing_studies(const Device& device, const Face& face, std::span<const StudiedMode> modes);

}  // namespace blush
