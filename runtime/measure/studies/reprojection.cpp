/// What the frame before adds to modes that take from it.

#include "runtime/measure/antialiasing_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::reprojection(const Device& device, const Face& face, double /*millimetres_a_unit*/,
                                         bool /*quick*/) {
    constexpr std::array<StudiedMode, 3> modes = {{
        {.label = "antialiasing.mode=smaa_1x", .work = "one frame alone", .mode = "smaa_1x"},
        {.label = "antialiasing.mode=smaa_t2x",
         .work = "two frames",
         .mode = "smaa_t2x",
         .frames = 2,
         .is_default = true},
        {.label = "antialiasing.mode=smaa_4x", .work = "two frames of two pictures", .mode = "smaa_4x", .frames = 2},
    }};
    return antialiasing_studies(device, face, modes);
}

}  // namespace blush
