#pragma once
/// What textures take in memory.

#include <algorithm>
#include <cstdint>

namespace blush {

/// RGTC2 (BC5, 3Dc): 16 bytes for two channels of a block of 4 x 4 texels, started blocks included.
constexpr std::uint64_t rgtc2_bytes(std::uint32_t width, std::uint32_t height) {
    return std::uint64_t{16} * ((width + 3) / 4) * ((height + 3) / 4);
}

/// The sum of bytes_of(width, height) over the mip levels of a texture, down to one texel.
template <class BytesOf>
constexpr std::uint64_t with_mip_levels(std::uint32_t width, std::uint32_t height, BytesOf bytes_of) {
    std::uint64_t sum = bytes_of(width, height);
    while (width > 1 || height > 1) {
        width = std::max(width / 2, 1U);
        height = std::max(height / 2, 1U);
        sum += bytes_of(width, height);
    }
    return sum;
}

}  // namespace blush
