#pragma once
/// Where the real heads and recordings are that this project does not ship.

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace blush::test {

/// The file or folder under the shared data, or nothing where that folder is absent. Looked for in the environment
/// variable BLUSH_SHARED_DATA, then beside the checkout.
inline std::optional<std::filesystem::path> shared_data(const std::filesystem::path& relative) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    const char* variable = std::getenv("BLUSH_SHARED_DATA");
    const fs::path roots[] = {variable ? fs::path(variable) : fs::path(BLUSH_SHARED_DATA),
                              fs::path(BLUSH_SOURCE_DIR) / "../shared/data"};
    for (const fs::path& root : roots) {
        if (!root.empty() && fs::exists(root / relative, ignored)) return root / relative;
    }
    return std::nullopt;
}

}  // namespace blush::test

/// Skips the test with a message where the shared data is absent.
#define BLUSH_SHARED_OR_SKIP(variable, relative)                                 \
    const auto variable##_found = blush::test::shared_data(relative);            \
    if (!variable##_found) GTEST_SKIP() << "shared data absent: " << (relative); \
    const std::filesystem::path variable = *variable##_found
