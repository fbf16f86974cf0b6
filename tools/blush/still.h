#pragma once
/// One moment of a face, drawn: what `render` writes and `explain` explains.

#include <nlohmann/json.hpp>
#include <string>

#include "tools/blush/performing.h"
#include "tools/blush/shot.h"

namespace blush::tool {

struct StillOptions {
    std::string face, output, report;
    PoseOptions pose;
    PerformOptions perform;
    ShotOptions shot{.size = "960x960", .light = {}};

    /// The options of `render`, all but --output: whether it is required is the command's.
    void add_to(Command& command);
};

struct Still {
    Image picture;  ///< radiance where the output's ending holds it, else sRGB
    nlohmann::ordered_json plan;
};
Result<Still> draw_still(const StillOptions& options);

}  // namespace blush::tool
