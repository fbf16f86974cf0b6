#include "tools/blush/assets.h"

namespace blush::tool {

namespace fs = std::filesystem;

fs::path asset_folder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (failed) return {};
    for (const char* place : {"../assets", "../share/blush"}) {
        const fs::path folder = program.parent_path() / place;
        if (fs::is_directory(folder, failed)) return folder.lexically_normal();
    }
    return {};
}

fs::path face_path(const std::string& name) { return name == "default" ? asset_folder() / "face.glb" : fs::path(name); }

}  // namespace blush::tool
