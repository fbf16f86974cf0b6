#pragma once
/// EXT_meshopt_compression (Khronos registry, extensions/2.0/Vendor/EXT_meshopt_compression): modes ATTRIBUTES,
/// TRIANGLES and INDICES, filters NONE, OCTAHEDRAL, QUATERNION and EXPONENTIAL.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/files/bytes.h"

namespace blush::load {

/// Checks the extension's own members against the number of compressed bytes; returns the number of decoded bytes.
/// Throws BadFile.
std::size_t check_meshopt(const nlohmann::json& extension, std::size_t compressed_bytes, const std::string& place);

/// Decodes what check_meshopt() let pass. Throws BadFile.
Bytes decode_meshopt(const nlohmann::json& extension, ByteView compressed, const std::string& place);

}  // namespace blush::load
