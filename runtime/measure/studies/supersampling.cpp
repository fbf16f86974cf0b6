/// Pictures a frame, by the number of them.

#include "runtime/measure/antialiasing_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::supersampling(const Device& device, const Face& face, double /*millimetres_a_unit*/,
                                          bool /*quick*/) {
    constexpr std::array<StudiedMode, 3> modes = {{
        {.label = "antialiasing.mode=none", .work = "1 picture", .mode = "none"},
        {.label = "supersampling.factor=2",
         .work = "4 pictures",
         .mode = "supersampled",
         .setting = "supersampling.factor",
         .choice = "2"},
        {.label = "supersampling.factor=4", .work = "16 pictures", .mode = "supersampled", .is_default = true},
    }};
    return antialiasing_studies(device, face, modes);
}

}  // namespace blush
