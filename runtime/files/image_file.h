#pragma once
/// Encoded images to pixels, through OpenImageIO.

#include <optional>
#include <string>

#include "rig/face.h"
#include "runtime/files/bytes.h"

namespace blush::load {

/// True for KTX 2 (Basis Universal) files, which no decoder here reads.
bool is_ktx2(ByteView encoded);

/// How a file holds its numbers.
struct StoredAs {
    std::string format;    ///< "png", "jpg", "webp", "hdr" or "exr"
    int channel_bits = 8;  ///< of a channel
    bool is_float = false;
};

/// Decodes PNG, JPEG, WebP, Radiance HDR or OpenEXR, told apart by their first bytes. Colour values stay as the file
/// has them: no conversion between sRGB and linear, no multiplication by alpha. The sides and the number of pixels
/// (`pixel_bytes_left`, from which the image's size is taken) are checked before pixels are allocated. stored: may be
/// null. Throws BadFile.
Image decode_image(ByteView encoded, std::uint32_t side_limit_pixels, std::uint64_t& pixel_bytes_left,
                   const std::string& place, StoredAs* stored = nullptr);

/// The picture as a PNG file: the same pixels give the same bytes. `pixels`: 8 bits, rows from the top, 1 to 4 channels
/// interleaved. Empty when OpenImageIO has no PNG writer.
Bytes encode_png(std::uint32_t width, std::uint32_t height, std::uint32_t channels, ByteView pixels);

}  // namespace blush::load
