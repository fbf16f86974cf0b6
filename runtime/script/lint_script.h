#pragma once
/// What is odd about a script: found by reading it and by letting it play to a face that is not there.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/motion/performance.h"
#include "rig/result.h"

namespace blush {

struct ScriptFinding {
    int line = 0;  ///< 0: the script as a whole
    std::string sentence;
};

/// Runs a minute of the script in steps of 1/30 s, with every event that it knows sent once, and looks at:
/// - errors: text that does not compile, calls that fail, bounds that are exceeded;
/// - names of controls that the rig does not have, in calls that were made and, as far as they are plain strings, in
/// those
///   that were not;
/// - steps that come near the bound on instructions;
/// - a script under which nothing moves at all.
/// Error: the file cannot be read.
Result<std::vector<ScriptFinding>> lint_script(
    const std::filesystem::path& path, const Rig& rig,
    std::function<Result<Performance>(const std::string& name)> find_performance = nullptr);

}  // namespace blush
