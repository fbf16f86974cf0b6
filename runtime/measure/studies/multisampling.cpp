/// Both ways to resolve samples; the study of antialiasing compares them with everything else.

#include "runtime/measure/antialiasing_study.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::multisampling(const Device& device, const Face& face, double /*millimetres_a_unit*/,
                                          bool /*quick*/) {
    constexpr std::array<StudiedMode, 3> modes = {{
        {.label = "antialiasing.mode=none", .work = "one sample", .mode = "none"},
        {.label = "multisampling.resolve=average",
         .work = "4 samples",
         .mode = "msaa4",
         .setting = "multisampling.resolve",
         .choice = "average"},
        {.label = "multisampling.resolve=hdr", .work = "4 samples", .mode = "msaa4", .is_default = true},
    }};
    return antialiasing_studies(device, face, modes);
}

}  // namespace blush
