#pragma once
/// Block compression of two signed channels: RGTC2, which is BC5 and 3Dc (GL 4.5, appendix D.2).

#include <cstdint>
#include <span>
#include <vector>

namespace blush {

/// 16 bytes for every block of 4 x 4 texels, rows from the first; texels beyond the edge repeat it. `texels`: two
/// signed bytes each, -127 to 127. Each channel of a block has its least and largest value and six between, so that no
/// texel is off by more than a fourteenth of the block's extent, and flat blocks are exact. The same on every driver,
/// whose own encoders are not (Mesa's lost up to 46 degrees of a normal).
std::vector<std::uint8_t> rgtc2_signed(std::span<const std::int8_t> texels, std::uint32_t width, std::uint32_t height);

/// The inverse, by the definition, as values of -1 to 1.
std::vector<float> from_rgtc2_signed(std::span<const std::uint8_t> blocks, std::uint32_t width, std::uint32_t height);

}  // namespace blush
