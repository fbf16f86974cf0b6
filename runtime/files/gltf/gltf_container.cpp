#include "runtime/files/gltf/gltf_container.h"

#include <algorithm>
#include <string>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr std::uint32_t chunk_json = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t chunk_bin = 0x004E4942;   // "BIN\0"

// tinygltf walks "extras" and "extensions" by recursion and takes the length of the text as an unsigned int.
constexpr int deepest_json = 64;
constexpr std::size_t longest_json_bytes = std::size_t{1} << 30;

std::uint32_t u32(ByteView bytes, std::size_t offset) {
    return static_cast<std::uint32_t>(bytes[offset]) | static_cast<std::uint32_t>(bytes[offset + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[offset + 2]) << 16 | static_cast<std::uint32_t>(bytes[offset + 3]) << 24;
}

ByteView without_byte_order_mark(ByteView text) {
    const bool has_mark = text.size() >= 3 && text[0] == 0xEF && text[1] == 0xBB && text[2] == 0xBF;
    return has_mark ? text.subspan(3) : text;
}

void check_depth(ByteView text) {
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > deepest_json) {
                refuse("", "the JSON is nested deeper than " + std::to_string(deepest_json) + " levels");
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
}

nlohmann::json parse_json(ByteView text) {
    text = without_byte_order_mark(text);
    if (text.size() > longest_json_bytes) refuse("", "the JSON text is longer than 1 GiB");
    check_depth(text);
    try {
        nlohmann::json json = nlohmann::json::parse(text.begin(), text.end());
        if (!json.is_object()) refuse("", "the JSON is not an object");
        return json;
    } catch (const nlohmann::json::parse_error& error) {
        refuse("", "the JSON cannot be parsed (at byte " + std::to_string(error.byte) + ")");
    }
}

GltfContainer split_glb(ByteView file) {
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    if (file.size() < header_bytes) refuse("", "the GLB header is cut short");
    if (const std::uint32_t version = u32(file, 4); version != 2) {
        refuse("", "GLB version " + std::to_string(version) + " is not understood, only 2 is");
    }
    const std::uint32_t stated_bytes = u32(file, 8);
    if (stated_bytes > file.size()) {
        refuse("", "the GLB header says " + std::to_string(stated_bytes) + " bytes, but the file has " +
                       std::to_string(file.size()));
    }
    file = file.first(stated_bytes);
    GltfContainer container;
    bool has_json = false;
    std::size_t offset = header_bytes;
    for (std::size_t number = 0; offset + chunk_header_bytes <= file.size(); ++number) {
        const std::size_t chunk_bytes = u32(file, offset);
        const std::uint32_t type = u32(file, offset + 4);
        offset += chunk_header_bytes;
        if (chunk_bytes > file.size() - offset) {
            refuse("chunk " + std::to_string(number), "it says " + std::to_string(chunk_bytes) + " bytes, but only " +
                                                          std::to_string(file.size() - offset) + " are left");
        }
        const ByteView chunk = file.subspan(offset, chunk_bytes);
        if (number == 0) {
            if (type != chunk_json) refuse("chunk 0", "the first chunk of a GLB must be JSON");
            container.json = parse_json(chunk);
            has_json = true;
        } else if (type == chunk_bin && !container.binary) {
            container.binary = chunk;
        }
        // Chunks start on multiples of 4; a writer that forgot to pad the last one is forgiven.
        offset = std::min(file.size(), offset + (chunk_bytes + 3) / 4 * 4);
    }
    if (!has_json) refuse("", "the GLB has no JSON chunk");
    return container;
}

}  // namespace

bool is_glb(ByteView file) { return file.size() >= 4 && u32(file, 0) == glb_magic; }

bool looks_like_gltf(ByteView file) {
    if (is_glb(file)) return true;
    const ByteView text = without_byte_order_mark(file);
    const auto first = std::find_if_not(text.begin(), text.end(),
                                        [](std::uint8_t c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
    return first != text.end() && *first == '{';
}

GltfContainer open_container(ByteView file) {
    if (is_glb(file)) return split_glb(file);
    return {parse_json(file), std::nullopt};
}

}  // namespace blush::load
