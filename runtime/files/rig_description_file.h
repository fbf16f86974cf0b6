#pragma once
/// Reading a rig description from a file: docs/rig_description.md.

#include <filesystem>
#include <optional>

#include "rig/controls/rig_description.h"
#include "rig/face.h"
#include "rig/result.h"

namespace blush {

/// The default description of the face with what the file says in place of it, checked. Never throws; a message names
/// file, place and reason.
Result<RigDescription> load_rig_description(const std::filesystem::path& path, const Face& face);

/// head.rig.json beside head.glb, where there is such a file.
std::optional<std::filesystem::path> rig_description_beside(const std::filesystem::path& face_file);

/// The description of a loaded face: from `named` where it is not empty, else from what stands beside the face's own
/// file, else from its target names.
Result<RigDescription> find_rig_description(const Face& face, const std::filesystem::path& named = {});

}  // namespace blush
