#pragma once
/// Programs as a user starts them: through the shell, with what they print on both streams and their exit status.

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "tests/gltf_builder.h"

namespace blush::test {

/// The bytes of a file; empty when there is none.
inline std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Paths of all that is in a folder, relative to it.
inline std::set<std::string> listing(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        names.insert(entry.path().lexically_relative(folder).string());
    }
    return names;
}

struct Ran {
    int exit_status = -1;  ///< -1 when a signal ended it
    std::string output;    ///< standard output
    std::string errors;    ///< standard error
};

/// Runs a command of the shell and waits for it.
inline Ran run(const std::string& command, const std::filesystem::path& in = ".") {
    const TemporaryFolder streams;
    const std::string output = (streams / "output").string(), errors = (streams / "errors").string();
    const int status =
        std::system(("cd '" + in.string() + "' && { " + command + "; } >" + output + " 2>" + errors).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
}

}  // namespace blush::test
