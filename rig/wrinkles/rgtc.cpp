#include "rig/wrinkles/rgtc.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace blush {
namespace {

constexpr std::uint32_t side = 4, channels = 2;
using Block = std::array<std::int8_t, side * side>;

/// Codes of eight levels, from the first value to the second: the ends, then what lies between.
constexpr std::array<std::uint64_t, 8> code_of_level = {0, 2, 3, 4, 5, 6, 7, 1};

void write_channel(const Block& values, std::vector<std::uint8_t>& out) {
    const auto [low, high] = std::ranges::minmax(values);
    out.push_back(std::bit_cast<std::uint8_t>(high));
    out.push_back(std::bit_cast<std::uint8_t>(low));
    std::uint64_t codes = 0;
    // With equal ends a decoder has six levels, of which code 0 is the value.
    for (std::size_t i = 0; i < values.size() && high > low; ++i) {
        const float level = 7.0F * static_cast<float>(high - values[i]) / static_cast<float>(high - low);
        codes |= code_of_level[static_cast<std::size_t>(std::lround(level))] << (3 * i);
    }
    for (int byte = 0; byte < 6; ++byte) out.push_back(static_cast<std::uint8_t>(codes >> (8 * byte)));
}

}  // namespace

std::vector<std::uint8_t> rgtc2_signed(std::span<const std::int8_t> texels, std::uint32_t width, std::uint32_t height) {
    assert(texels.size() == std::size_t{channels} * width * height && "two bytes for each texel");
    std::vector<std::uint8_t> blocks;
    blocks.reserve(std::size_t{16} * ((width + 3) / 4) * ((height + 3) / 4));
    for (std::uint32_t y = 0; y < height; y += side) {
        for (std::uint32_t x = 0; x < width; x += side) {
            for (std::uint32_t c = 0; c < channels; ++c) {
                Block values{};
                for (std::uint32_t i = 0; i < values.size(); ++i) {
                    const std::size_t from_x = std::min(x + i % side, width - 1),
                                      from_y = std::min(y + i / side, height - 1);
                    values[i] = texels[channels * (from_y * width + from_x) + c];
                }
                write_channel(values, blocks);
            }
        }
    }
    return blocks;
}

std::vector<float> from_rgtc2_signed(std::span<const std::uint8_t> blocks, std::uint32_t width, std::uint32_t height) {
    std::vector<float> values(std::size_t{channels} * width * height);
    const std::uint32_t across = (width + side - 1) / side;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            for (std::uint32_t c = 0; c < channels; ++c) {
                const std::uint8_t* const block =
                    &blocks[8 * (channels * (std::size_t{y / side} * across + x / side) + c)];
                const auto end = [&](int i) {
                    return std::max(static_cast<float>(std::bit_cast<std::int8_t>(block[i])) / 127.0F, -1.0F);
                };
                std::uint64_t codes = 0;
                for (int byte = 0; byte < 6; ++byte) codes |= std::uint64_t{block[2 + byte]} << (8 * byte);
                const auto code = static_cast<int>(codes >> (3 * (y % side * side + x % side)) & 7U);
                const bool eight = std::bit_cast<std::int8_t>(block[0]) > std::bit_cast<std::int8_t>(block[1]);
                float value = 0;
                if (code < 2) {
                    value = end(code);
                } else if (eight || code < 6) {
                    const int steps = eight ? 7 : 5, along = code - 1;
                    value = (static_cast<float>(steps - along) * end(0) + static_cast<float>(along) * end(1)) /
                            static_cast<float>(steps);
                } else {
                    value = code == 6 ? -1.0F : 1.0F;
                }
                values[channels * (std::size_t{y} * width + x) + c] = value;
            }
        }
    }
    return values;
}

}  // namespace blush
