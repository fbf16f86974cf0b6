#pragma once
/// A folder for results, made before the long work and removed after it when nothing was written into it.

#include <filesystem>

#include "rig/result.h"

namespace blush::tool {

class NewFolder {
public:
    NewFolder() = default;
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder() {
        std::error_code not_empty;
        if (!made_.empty()) std::filesystem::remove(made_, not_empty);
    }

    /// Makes `folder` where it is missing; its parent must be there. Once an object. Error: it cannot be made.
    Status make(const std::filesystem::path& folder) {
        std::error_code failed;
        if (std::filesystem::is_directory(folder, failed)) return Done{};
        if (!std::filesystem::create_directory(folder, failed)) {
            return Error{folder.string() + ": this folder cannot be made" + (failed ? ": " + failed.message() : "")};
        }
        made_ = folder;
        return Done{};
    }

private:
    std::filesystem::path made_;
};

}  // namespace blush::tool
