#pragma once
/// --lights, --environment: what lights a frame.

#include <optional>
#include <string>

#include "runtime/lighting.h"
#include "tools/command_line/command_line.h"

namespace blush::tool {

struct LightOptions {
    std::string lights, environment;
    float environment_turn_degrees = 0, environment_factor = 1;

    void add_to(Command& command);
    /// Nothing when neither is given: the frame's own lights. Error: a file or a name that is not what it should be.
    Result<std::optional<Lighting>> lighting(const Face& face, double millimetres_a_unit) const;
};

}  // namespace blush::tool
