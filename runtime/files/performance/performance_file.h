#pragma once
/// Reading a performance from a file: Live Link Face CSV, or the project's own JSON (docs/performance_format.md).

#include <filesystem>

#include "rig/motion/performance.h"
#include "rig/result.h"

namespace blush {

/// The format is told by content, not by name. Never throws; a message names file, row or path in the file, and reason.
Result<Performance> load_performance(const std::filesystem::path& path);

}  // namespace blush
