#pragma once
/// Reading a face from a file: .glb, .gltf (tinygltf) and .obj (OpenMesh, no targets).

#include <cstdint>
#include <filesystem>

#include "rig/face.h"
#include "rig/result.h"

namespace blush {

/// What a loader may take from a file that it does not trust.
struct LoadLimits {
    std::uint64_t file_bytes = 4ULL << 30;
    std::uint32_t vertices = 64'000'000;
    std::uint32_t targets = 1'000'000;
    std::uint32_t image_side_pixels = 16'384;
};

/// Loads and validates. On error nothing remains, and the message names file, place and reason. Never throws.
Result<Face> load_face(const std::filesystem::path& path, const LoadLimits& limits = {});

}  // namespace blush
