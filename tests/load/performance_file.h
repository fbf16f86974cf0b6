#pragma once
/// A performance written to a temporary file and loaded from it.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include "runtime/files/performance/performance_file.h"

namespace blush::test {

/// A file of this process alone, removed at the end of its scope.
class TemporaryFile {
public:
    TemporaryFile(std::string_view name, std::string_view contents)
        : path_(std::filesystem::temp_directory_path() /
                ("blush_" + std::to_string(getpid()) + "_" + std::string(name))) {
        std::ofstream(path_, std::ios::binary).write(contents.data(), static_cast<std::streamsize>(contents.size()));
    }
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline Result<Performance> load_text(std::string_view text) {
    const TemporaryFile file("text", text);
    return load_performance(file.path());
}

/// The message without the file that must open it; says so where the text loads or the file is not named.
inline std::string message_of(std::string_view text) {
    const TemporaryFile file("text", text);
    const Result<Performance> loaded = load_performance(file.path());
    if (loaded) return "(loads)";
    const std::string opening = file.path().string() + ": ", &message = loaded.error().message;
    return message.starts_with(opening) ? message.substr(opening.size()) : "(does not name the file) " + message;
}

}  // namespace blush::test
