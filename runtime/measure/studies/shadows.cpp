/// Sizes and edges of shadow maps in whole frames.

#include "runtime/measure/frame_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::shadows(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    std::vector<Study> result = frame_study(device, face, millimetres_a_unit,
                                            {"shadows.size", {"512", "1024", "2048"}, 1, "2048", &study_backlight()});
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"shadows.edges", {"soft", "sharp"}, 0, "soft", &study_backlight()})) {
        result.push_back(std::move(study));
    }
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"shadows.method", {"maps", "off"}, 0, "maps", &study_backlight()})) {
        result.push_back(std::move(study));
    }
    return result;
}

}  // namespace blush
