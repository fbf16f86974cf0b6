#include "tools/blush/playback.h"

#include <algorithm>
#include <iostream>

#include "runtime/files/performance/performance_file.h"
#include "tools/blush/assets.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

std::string shipped_names() {
    std::string names;
    for (const std::string& name : shipped("performances", ".json")) names += ", " + name;
    return names;
}

void list(const std::string& what, std::span<const std::string> names) {
    if (names.empty()) return;
    std::cerr << "note: " << names.size() << " " << what << ": ";
    for (std::size_t i = 0; i < names.size(); ++i) std::cerr << (i == 0 ? "" : ", ") << names[i];
    std::cerr << "\n";
}

}  // namespace

std::vector<std::string> shipped(const std::string& folder, const std::string& ending) {
    std::vector<std::string> names;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(asset_folder() / folder, failed)) {
        if (entry.path().extension() == ending) names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

Result<Performance> find_performance(const Face& face, const std::string& name) {
    if (name.empty() && !face.animations.empty()) return performance_from_animations(face, std::nullopt);
    const std::string wanted = name.empty() ? "first_light" : name;
    for (std::size_t a = 0; a < face.animations.size(); ++a) {
        if (face.animations[a].name == wanted) return performance_from_animations(face, a);
    }
    std::error_code failed;
    const fs::path shipped = asset_folder() / "performances" / (wanted + ".json");
    if (wanted.find('/') == std::string::npos && fs::exists(shipped, failed)) return load_performance(shipped);
    if (fs::exists(wanted, failed)) return load_performance(wanted);
    std::string known;
    for (const Animation& animation : face.animations) {
        if (!animation.name.empty()) known += ", " + animation.name;
    }
    known += shipped_names();
    return Error{"--performance " + wanted + ": neither a file, nor an animation of " + face.path +
                 ", nor shipped (there are: " + (known.empty() ? "none" : known.substr(2)) + ")"};
}

void report_matches(const BoundPerformance& performance, const Face& face) {
    for (const std::string& note : performance.performance().notes) std::cerr << "note: " << note << "\n";
    list("channels without a control on " + face.path, performance.unmatched_channels());
    list("targets of " + face.path + " without a channel", performance.undriven_targets());
}

}  // namespace blush::tool
