#pragma once
/// Pictures as files that keep their depth: what comes in as 16 bits goes out as 16 bits.

#include <filesystem>

#include "rig/face.h"
#include "rig/result.h"

namespace blush {

enum class PictureDepth : std::uint8_t { bits_8, bits_16, half, single };  ///< of a channel; half and single: floats

struct PictureFile {
    Image image;  ///< bytes of 8-bit files, else floats: those of 16-bit files are 0 to 1
    PictureDepth depth = PictureDepth::bits_8;
    bool linear = false;               ///< numbers stand for light (OpenEXR, Radiance HDR), not for sRGB
    bool premultiplied_alpha = false;  ///< colours are multiplied by alpha (OpenEXR)
};

/// Reads PNG, JPEG, WebP, Radiance HDR or OpenEXR, told apart by their first bytes. Error: no such file, or one that
/// cannot be decoded, with the reason.
Result<PictureFile> load_picture(const std::filesystem::path& path);

/// Writes a picture of any number of channels with its depth, or the nearest that the format has: .png (8 or 16 bits),
/// .exr (half or single), .tif, .jpg and others that OpenImageIO knows. Numbers are written as they are.
Status write_picture(const std::filesystem::path& path, const PictureFile& picture);

/// Whether write_picture() may succeed: the ending is known and the folder is there. Error: as of write_picture().
Status can_write_picture(const std::filesystem::path& path);

}  // namespace blush
