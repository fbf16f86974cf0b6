#pragma once
/// Appearance maps and what they are made from, from files and back. No GL. Nothing here throws; a message names file,
/// place and reason.

#include <filesystem>
#include <vector>

#include "rig/blood/appearance.h"
#include "rig/blood/hemoglobin_pattern.h"
#include "rig/map.h"
#include "rig/result.h"

namespace blush {

/// A colour texture as linear sRGB. PNG (8 or 16 bits), JPEG and WebP are sRGB; HDR and EXR are linear already. Texels
/// that are not finite become 0, alpha is dropped. Error: no colour in it (one or two channels), more than
/// 16,384 pixels a side, a damaged file.
Result<ColourMap> load_colour_map(const std::filesystem::path& path);
/// The same of an image that is in memory. `name` is for the message; `linear`: its floats are.
Result<ColourMap> colour_map_of(const Image& image, const std::string& name, bool linear = false);

/// A mask or a map of plain numbers: the first channel, 0 to 1 for 8 and 16 bits, as it is for HDR and EXR.
Result<ScalarMap> load_scalar_map(const std::filesystem::path& path);

/// Writes a map as 8-bit grey, 0 to 1; values beyond are clamped.
Status write_scalar_map(const std::filesystem::path& path, const ScalarMap& map);
/// Writes linear colours as 8-bit sRGB, or as they are where the name ends in .exr.
Status write_colour_map(const std::filesystem::path& path, const ColourMap& map);

/// melanin.png, hemoglobin.png (8 bits, coordinates of the table: cube roots, jimenez-2012, 7.7), skin.png, and
/// residual.exr, in a folder that exists.
Status write_appearance(const std::filesystem::path& folder, const AppearanceMaps& maps);
/// Reads them again. Maps may be painted by hand and of different sizes: the others are brought to the size of
/// hemoglobin.png. skin.png and residual.exr may be missing: skin everywhere, and no residual.
Result<AppearanceMaps> load_appearance(const std::filesystem::path& folder);

/// NAME.exr for each of the maps: the scale in the first channel and the offset in the second, 16-bit float.
Status write_hemoglobin_maps(const std::filesystem::path& folder, const HemoglobinMaps& maps);

/// Reads those of them, by hemoglobin_pattern_names, that are there. Error: maps of two sizes, or more than 4,096
/// texels a side.
Result<HemoglobinMaps> load_hemoglobin_maps(const std::filesystem::path& folder);

/// A pattern as JSON (docs/appearance.md describes the format; unknown keys are errors).
Result<HemoglobinPattern> load_hemoglobin_pattern(const std::filesystem::path& path);
/// All that the project ships, by hemoglobin_pattern_names, out of one folder.
Result<std::vector<HemoglobinPattern>> load_hemoglobin_patterns(const std::filesystem::path& folder);

/// {"left_eye": [u, v], "right_eye": [u, v], "mouth": [u, v]}, texture coordinates, v down. left_eye is the face's own.
Result<TextureLandmarks> load_texture_landmarks(const std::filesystem::path& path);

}  // namespace blush
