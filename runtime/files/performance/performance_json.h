#pragma once
/// The project's own performances: docs/performance_format.md.

#include <string>
#include <string_view>

#include "rig/motion/performance.h"
#include "rig/result.h"

namespace blush {

/// Reads a JSON text without byte-order mark. `file` opens every message; the place is a line and column where the text
/// is not JSON, else a path such as channels.jawOpen.keys[3][1]. The name is the file's own, or empty.
Result<Performance> read_performance_json(std::string_view text, const std::string& file);

}  // namespace blush
