/// Bloom by its radius, against the pyramid in double precision.

#include "rig/camera/bloom.h"
#include "runtime/measure/camera_pictures.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::bloom(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    const auto plain = pictured(device, face, millimetres_a_unit, Output::linear_hdr, {});
    if (!plain) return {};
    const auto before = std::make_shared<ExactPicture>(plain->picture());
    Study study{"whole frames of 192x192 pixels, bloom of 0.2",
                "the pyramid in double precision on the CPU",
                "% of the mean light",
                {},
                before};
    for (const char* radius : {"0.02", "0.06", "0.2"}) {
        const auto shown = pictured(device, face, millimetres_a_unit, Output::linear_hdr,
                                    {{"bloom.strength", "0.2"}, {"bloom.radius", radius}});
        if (!shown) return {};
        Variant variant;
        variant.label = std::string("bloom.radius=") + radius;
        const std::uint32_t levels =
            bloom_levels(std::stod(radius), PicturedFace::side_pixels, PicturedFace::side_pixels);
        variant.work = std::to_string(2 * levels) + " passes";
        variant.is_default = std::string_view(radius) == "0.06";
        variant.run = [shown] { shown->draw(); };
        variant.error = [shown, before, levels] {
            return percent_of_mean(shown->picture(), bloomed(*before, 0.2, 0, levels));
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
