#include "tools/blush/light_options.h"

#include <filesystem>

#include "rig/controls/head_and_eyes.h"
#include "runtime/files/lighting_file.h"

namespace blush::tool {

void LightOptions::add_to(Command& command) {
    command.option("--lights", &lights, "front, side, behind, orbit, or a .json file (docs/skin.md)");
    command.option("--environment", &environment, "A radiance map, .hdr or .exr in equal longitudes and latitudes");
    command.option("--environment-turn", &environment_turn_degrees, "Turns the environment about +Y, degrees")
        .range(-360, 360);
    command.option("--environment-factor", &environment_factor, "Factor on its radiance").range(0, 1e4);
}

Result<std::optional<Lighting>> LightOptions::lighting(const Face& face, double millimetres_a_unit) const {
    if (lights.empty() && environment.empty()) return std::optional<Lighting>();
    Lighting result;
    if (!lights.empty()) {
        Result<Lighting> read = std::filesystem::path(lights).extension() == ".json"
                                    ? read_lighting(lights, moving_bounds(face), millimetres_a_unit)
                                    : named_lighting(lights);
        if (!read) return Error{"--lights: " + read.error().message};
        result = *std::move(read);
    }
    if (!environment.empty()) {
        Result<std::shared_ptr<const Environment>> read = read_environment(environment);
        if (!read) return Error{"--environment: " + read.error().message};
        result.environment = *std::move(read);
        result.environment_turn_radians = glm::radians(environment_turn_degrees);
        result.environment_factor = environment_factor;
    }
    return std::optional<Lighting>(std::move(result));
}

}  // namespace blush::tool
