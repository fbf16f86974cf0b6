#pragma once
/// Performances, found by name.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/motion/performance.h"

namespace blush::tool {

/// Names, without their ending, of what the program ships in a folder of its assets; sorted.
std::vector<std::string> shipped(const std::string& folder, const std::string& ending);

/// Finds a performance for a face: nothing named: the file's own animations, or for a face without any the shipped
/// "first_light"; else an animation of the file by its name, a shipped performance by its name, or a file.
/// Error: nothing of that name, with what there is.
Result<Performance> find_performance(const Face& face, const std::string& name);

/// Names once every channel without a control and every target without a channel, and the performance's own notes, on
/// standard error.
void report_matches(const BoundPerformance& performance, const Face& face);

}  // namespace blush::tool
