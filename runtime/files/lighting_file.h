#pragma once
/// Lights and environments from files and by name.

#include <filesystem>
#include <memory>
#include <string_view>

#include "rig/controls/head_and_eyes.h"
#include "rig/result.h"
#include "runtime/lighting.h"

namespace blush {

/// A lighting by name: "front", "side", "behind", fixed to the head and not to the camera; "orbit": a dim one in front
/// and a bright one that goes once round the head in a minute. Error: no such name (the
/// message lists them).
Result<Lighting> named_lighting(std::string_view name);

/// Reads lights (docs/skin.md describes the format). Places are in millimetres from the middle of `head`, turned as the
/// face is: x to its left, y up, z to its front. Error: a file that cannot be read, or whose contents are not as
/// described, with the place in it.
Result<Lighting> read_lighting(const std::filesystem::path& path, const Bounds& head, double millimetres_a_unit);

/// Reads and prepares a radiance map (.hdr or .exr in equal longitudes and latitudes). Error: no such file, not an
/// image.
Result<std::shared_ptr<const Environment>> read_environment(const std::filesystem::path& path);

}  // namespace blush
