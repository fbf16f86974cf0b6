#pragma once
/// Occlusion coefficients on disk: "head.occlusion" beside "head.glb". No GL. Nothing here throws; a message names
/// file, place and reason.

#include <filesystem>
#include <optional>

#include "rig/face.h"
#include "rig/light/occlusion.h"
#include "rig/result.h"

namespace blush {

/// Where the coefficients of a face are looked for.
std::filesystem::path occlusion_path(const std::filesystem::path& face);

/// Little-endian: "BLUSHOCC", version (4 bytes), poses (4), vertices (4), 0 (4), the face's identity (8); for each pose
/// the bytes of its target's name (4), the name, and nine whole numbers of 16 bits a vertex, 16,384 for 1: within 3e-5,
/// and nothing that is not finite can be said.
Status write_occlusion(const std::filesystem::path& path, const OcclusionSet& set);

/// Of that face. Error: a damaged file, or one that was made for another surface.
Result<OcclusionSet> load_occlusion(const std::filesystem::path& path, const Face& face);

/// What stands beside the face's own file; nothing where nothing does.
Result<std::optional<OcclusionSet>> find_occlusion(const Face& face);

}  // namespace blush
