// Block compression of derivatives.

#include "rig/wrinkles/rgtc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rig/wrinkles/texture_bytes.h"

namespace blush {
namespace {

std::vector<std::int8_t> noise(std::uint32_t width, std::uint32_t height) {
    std::vector<std::int8_t> texels;
    for (std::uint32_t i = 0; i < 2 * width * height; ++i)
        texels.push_back(static_cast<std::int8_t>(static_cast<int>((i * 2654435761U) >> 24U) % 255 - 127));
    return texels;
}

TEST(Rgtc, NoTexelIsOffByMoreThanAFourteenthOfItsBlock) {
    for (const auto& [width, height] : {std::pair(16U, 8U), std::pair(5U, 7U), std::pair(1U, 1U), std::pair(3U, 9U)}) {
        const std::vector<std::int8_t> texels = noise(width, height);
        const std::vector<std::uint8_t> blocks = rgtc2_signed(texels, width, height);
        EXPECT_EQ(blocks.size(), rgtc2_bytes(width, height));
        const std::vector<float> back = from_rgtc2_signed(blocks, width, height);
        for (std::uint32_t i = 0; i < texels.size(); ++i) {
            const std::uint32_t x = i / 2 % width / 4 * 4, y = i / 2 / width / 4 * 4;
            int low = 127, high = -127;
            for (std::uint32_t v = y; v < std::min(y + 4, height); ++v) {
                for (std::uint32_t u = x; u < std::min(x + 4, width); ++u) {
                    low = std::min<int>(low, texels[2 * (v * width + u) + i % 2]);
                    high = std::max<int>(high, texels[2 * (v * width + u) + i % 2]);
                }
            }
            ASSERT_LE(std::abs(127 * back[i] - static_cast<float>(texels[i])),
                      static_cast<float>(high - low) / 14 + 1e-3F);
        }
    }
}

TEST(Rgtc, FlatBlocksAndTheirEndsAreExact) {
    for (const int value : {0, 1, -1, 127, -127, 50}) {
        const std::vector<std::int8_t> texels(32, static_cast<std::int8_t>(value));
        for (const float back : from_rgtc2_signed(rgtc2_signed(texels, 4, 4), 4, 4))
            EXPECT_EQ(back, static_cast<float>(value) / 127.0F);
    }
    std::vector<std::int8_t> two(32, 0);
    two[0] = 100;
    two[9] = -100;
    const std::vector<float> back = from_rgtc2_signed(rgtc2_signed(two, 4, 4), 4, 4);
    EXPECT_EQ(back[0], 100.0F / 127.0F);
    EXPECT_EQ(back[9], -100.0F / 127.0F);
}

}  // namespace
}  // namespace blush
