/// Blood on the face's texture and in whole frames, against its exact twins on the CPU.

#include "runtime/measure/appearance_frames.h"
#include "runtime/measure/appearance_probe.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::blood(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    std::shared_ptr<AppearanceProbe> probe = AppearanceProbe::create(device, face);
    if (!probe || !probe->state().asset.appearance().pigments) return {};
    Study study{"anger on the face's texture, 256 x 256 points",
                "equation 7.6 and the table on the CPU",
                "CIEDE2000",
                {},
                probe};
    Variant on;
    on.label = "blood";
    on.is_default = true;
    on.work = "3 lookups a pixel and 1 of the texture";
    on.run = [probe] { probe->draw_colors("anger"); };
    on.error = [probe] { return probe->color_error("anger"); };
    study.variants.push_back(std::move(on));
    Variant off;
    off.label = "left out";
    off.work = "1 lookup of the texture";
    off.run = [probe] { probe->draw_colors(""); };
    off.error = [probe] { return probe->color_error("anger", false); };
    study.variants.push_back(std::move(off));
    std::vector<Study> result = blood_frame_study(device, face, millimetres_a_unit);
    result.push_back(std::move(study));
    return result;
}

}  // namespace blush
