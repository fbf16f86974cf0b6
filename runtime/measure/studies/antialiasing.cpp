/// Every way to smooth edges, against the mean of 64 pictures.

#include "runtime/measure/antialiasing_study.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

constexpr StudiedMode preset(std::string_view label, std::string_view choice) {
    return {.label = label,
            .work = "one sample, filtered",
            .mode = "smaa_1x",
            .setting = "antialiasing.preset",
            .choice = choice};
}

constexpr std::array<StudiedMode, 11> modes = {{
    {.label = "antialiasing.mode=none", .work = "one sample", .mode = "none"},
    {.label = "antialiasing.mode=msaa4", .work = "4 samples", .mode = "msaa4", .is_default = true},
    {.label = "antialiasing.mode=mlaa", .work = "one sample, filtered", .mode = "mlaa"},
    preset("smaa_1x, preset low", "low"),
    preset("smaa_1x, preset medium", "medium"),
    preset("smaa_1x, preset high", "high"),
    preset("smaa_1x, preset ultra", "ultra"),
    {.label = "antialiasing.mode=smaa_s2x", .work = "two pictures, filtered", .mode = "smaa_s2x"},
    {.label = "antialiasing.mode=smaa_t2x", .work = "two frames, filtered", .mode = "smaa_t2x", .frames = 2},
    {.label = "antialiasing.mode=smaa_4x",
     .work = "two frames of two pictures, filtered",
     .mode = "smaa_4x",
     .frames = 2},
    {.label = "antialiasing.mode=supersampled", .work = "16 pictures", .mode = "supersampled"},
}};

}  // namespace

std::vector<Study> studies::antialiasing(const Device& device, const Face& face, double /*millimetres_a_unit*/,
                                         bool /*quick*/) {
    return antialiasing_studies(device, face, modes);
}

}  // namespace blush
