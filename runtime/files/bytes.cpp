#include "runtime/files/bytes.h"

#include <array>
#include <fstream>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::array<std::int8_t, 256> base64_values() {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
    }
    return values;
}

}  // namespace

Bytes read_file(const std::filesystem::path& path, std::uint64_t limit, std::string_view place) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) refuse(place, "there is no such file");
    if (fs::is_directory(status)) refuse(place, "this is a folder, not a file");
    if (!fs::is_regular_file(status)) refuse(place, "this is not a regular file");
    const std::uint64_t size = fs::file_size(path, error);
    if (error) refuse(place, "the file cannot be read (" + error.message() + ")");
    if (size > limit) {
        refuse(place,
               "the file has " + std::to_string(size) + " bytes; at most " + std::to_string(limit) + " are read");
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) refuse(place, "the file cannot be opened");
    Bytes bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uint64_t>(stream.gcount()) != size) refuse(place, "the file ended while it was read");
    return bytes;
}

Bytes decode_base64(std::string_view text, std::string_view place) {
    static const std::array<std::int8_t, 256> values = base64_values();
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t pending = 0;
    int pending_bits = 0;
    for (const char c : text) {
        const std::int32_t value{values[static_cast<unsigned char>(c)]};  // -1: none of the alphabet
        if (value < 0) refuse(place, "the base64 text has a character that does not belong to it");
        pending = (pending << 6) | static_cast<std::uint32_t>(value);
        pending_bits += 6;
        if (pending_bits >= 8) {
            pending_bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>((pending >> pending_bits) & 0xFFU));
        }
    }
    return bytes;
}

std::string decode_percent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
            decoded.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

}  // namespace blush::load
