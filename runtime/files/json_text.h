#pragma once
/// JSON text that came from a user: parsed with bounds, refused with a line and a column.

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "rig/result.h"

namespace blush {

using Json = nlohmann::ordered_json;  // keys stay in the order of the file

/// Error: text that is not JSON (with line and column), more than 64 MiB of it, nested more than 16 deep, more than
/// 16,384 keys in an object, a key that stands twice in one. `what` names the kind of file: "a JSON performance".
Result<Json> parse_json(std::string_view text, const std::string& file, const std::string& what);

}  // namespace blush
