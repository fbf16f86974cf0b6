#pragma once
/// The outer shell of a glTF file: GLB chunks (glTF 2.0, 4.4) and the JSON text, before anything else reads them.

#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/files/bytes.h"

namespace blush::load {

struct GltfContainer {
    nlohmann::json json;             ///< an object
    std::optional<ByteView> binary;  ///< the BIN chunk of a GLB, inside the bytes given
};

/// True for the GLB magic.
bool is_glb(ByteView file);

/// True for the GLB magic, and for text whose first character (after a byte-order mark and white space) is '{'.
bool looks_like_gltf(ByteView file);

/// Splits and parses. Throws BadFile.
GltfContainer open_container(ByteView file);

}  // namespace blush::load
