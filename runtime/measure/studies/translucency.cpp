/// What light through thin parts costs, with a light behind the head.

#include "runtime/measure/frame_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::translucency(const Device& device, const Face& face, double millimetres_a_unit,
                                         bool /*quick*/) {
    return frame_study(device, face, millimetres_a_unit,
                       {"translucency.strength", {"1", "0"}, 0, "1", &study_backlight(), 2.5F});
}

}  // namespace blush
