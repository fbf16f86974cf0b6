#pragma once
/// FaceAppearance: the maps that a face's wrinkles and blood are drawn from.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rig/blood/appearance.h"
#include "rig/blood/hemoglobin_pattern.h"
#include "rig/result.h"
#include "runtime/files/wrinkle_file.h"

namespace blush {

/// What pigments say of a face's skin, and what each expression does to the blood in it.
struct SkinPigments {
    AppearanceMaps maps;
    HemoglobinMaps blood;  ///< by the names of Rig::hemoglobin_maps(); those that are missing change nothing
};

struct FaceAppearance {
    std::optional<WrinkleSet> wrinkles;
    std::optional<SkinPigments> pigments;
};

/// Where the maps of a face are looked for: "head.appearance" beside "head.glb".
std::filesystem::path appearance_folder(const std::filesystem::path& face);

/// What `blush bake` left in a folder: wrinkles where wrinkles.json is, pigments where melanin.png is, and of the
/// blood's maps those that are there. Without the folder, an appearance without anything. Error: a map that is damaged.
Result<FaceAppearance> load_face_appearance(const std::filesystem::path& folder);

}  // namespace blush
