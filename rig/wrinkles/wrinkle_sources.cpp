#include "rig/wrinkles/wrinkle_sources.h"

#include <algorithm>

namespace blush {

std::vector<WrinkleSource> wrinkle_sources(const Rig& rig, const RigDescription& description) {
    std::vector<WrinkleSource> sources;
    std::vector<float> controls(rig.control_names().size());
    Pose pose = rig.rest_pose();
    for (const WrinkleRow& row : description.wrinkles) {
        std::ranges::fill(controls, 0.0F);
        bool known = true;
        for (const std::string& driver : row.drivers) {
            const std::optional<ControlId> control = rig.find(driver);
            known = known && control.has_value();
            if (control) controls[static_cast<std::size_t>(*control)] = 1;
        }
        if (!known) continue;
        rig.evaluate(controls, pose);
        if (std::ranges::all_of(pose.weights, [](float weight) { return weight == 0; })) continue;
        sources.push_back({pose.weights, pose.wrinkles});
    }
    return sources;
}

}  // namespace blush
