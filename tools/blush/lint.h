#pragma once
/// What a linter finds odd about a file.

#include <filesystem>
#include <string>
#include <vector>

#include "rig/controls/rig_description.h"
#include "rig/face.h"
#include "rig/result.h"

namespace blush::tool {

/// "targets.jawOpen: it moves nothing"
struct Finding {
    std::string place, sentence;
};
using Findings = std::vector<Finding>;

/// A linter for one kind of file. `face`: the one that the user named, or empty. Error: the file cannot be read.
using Linter = Result<Findings> (*)(const std::filesystem::path& file, const std::string& face);

Result<Findings> lint_face(const std::filesystem::path& file, const std::string& face);
Result<Findings> lint_rig(const std::filesystem::path& file, const std::string& face);
/// Without a face, of one that has all of ARKit's shapes.
Result<Findings> lint_script_file(const std::filesystem::path& file, const std::string& face);

}  // namespace blush::tool
