/// What shading eyes and hair in their own ways costs, and what it changes.

#include <algorithm>
#include <iterator>

#include "runtime/measure/frame_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::parts(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    std::vector<Study> both;
    for (const char* setting : {"parts.eyes", "parts.hair"}) {
        const std::string own = std::string(setting) == "parts.eyes" ? "wet" : "strands";
        auto one = frame_study(device, face, millimetres_a_unit, {setting, {own, "plain"}, 0, own, nullptr});
        std::ranges::move(one, std::back_inserter(both));
    }
    return both;
}

}  // namespace blush
