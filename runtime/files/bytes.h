#pragma once
/// Whole files as bytes.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace blush::load {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Reads a regular file of at most `limit` bytes. `place` names it in messages. Throws BadFile.
Bytes read_file(const std::filesystem::path& path, std::uint64_t limit, std::string_view place);

/// Decodes RFC 4648 base 64 (padding optional, no line breaks). Throws BadFile.
Bytes decode_base64(std::string_view text, std::string_view place);

/// Replaces %41 by 'A' (RFC 3986, 2.1).
std::string decode_percent(std::string_view text);

}  // namespace blush::load
