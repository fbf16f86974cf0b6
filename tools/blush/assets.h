#pragma once
/// What the program ships.

#include <filesystem>
#include <string>

namespace blush::tool {

/// The face file that a user means: "default" is the one that this program ships.
std::filesystem::path face_path(const std::string& name);
/// Folder of what the program ships, beside the build or the installation; empty when there is none.
std::filesystem::path asset_folder();

}  // namespace blush::tool
