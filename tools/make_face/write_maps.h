#pragma once
/// The painted pigments as the folder that the runtime reads (docs/appearance.md), with what expressions and states do
/// to the blood.

#include <filesystem>

#include "rig/blood/appearance.h"
#include "rig/result.h"

namespace blush::make_face {

/// `face`: the written .glb, whose targets say where eyes and mouth are. `patterns`: folder of the hemoglobin patterns.
/// The folder is made where it is missing, in one that exists.
Status write_maps(const std::filesystem::path& folder, const AppearanceMaps& pigments,
                  const std::filesystem::path& face, const std::filesystem::path& patterns);

}  // namespace blush::make_face
