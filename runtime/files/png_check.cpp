#include "runtime/files/png_check.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table = [] {
    constexpr std::uint32_t polynomial = 0xEDB88320;  // CRC-32, bits reversed
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
        std::uint32_t c = n;
        for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? polynomial ^ (c >> 1) : c >> 1;
        table[n] = c;
    }
    return table;
}();

std::uint32_t crc32(ByteView bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) crc = crc_table[(crc ^ byte) & 0xFFU] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t big_endian(ByteView bytes) {
    return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
           static_cast<std::uint32_t>(bytes[2]) << 8 | static_cast<std::uint32_t>(bytes[3]);
}

}  // namespace

void check_png(ByteView encoded, const std::string& place) {
    constexpr std::size_t signature = 8, frame = 12;  // length, type and checksum around a chunk's data
    ByteView rest = encoded.subspan(std::min(signature, encoded.size()));
    while (true) {
        if (rest.size() < frame || big_endian(rest) > rest.size() - frame) refuse(place, "the PNG is cut short");
        const std::size_t length = big_endian(rest);
        const ByteView type_and_data = rest.subspan(4, 4 + length);
        if (crc32(type_and_data) != big_endian(rest.subspan(8 + length)))
            refuse(place, "a chunk of the PNG is damaged");
        constexpr std::string_view last = "IEND";
        if (std::equal(last.begin(), last.end(), type_and_data.begin())) return;
        rest = rest.subspan(frame + length);
    }
}

}  // namespace blush::load
