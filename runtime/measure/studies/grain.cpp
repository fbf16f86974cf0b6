/// Grain of film, against its noise in double precision.

#include "rig/camera/film_grain.h"
#include "runtime/measure/camera_pictures.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::grain(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    const auto plain = pictured(device, face, millimetres_a_unit, Output::display_srgb, {});
    if (!plain) return {};
    const auto before = std::make_shared<ExactPicture>(plain->picture());
    Study study{"whole frames of 192x192 pixels, grain of 0.05",
                "the noise in double precision on the CPU",
                "% of the mean display value",
                {},
                before};
    for (const char* size : {"1", "2.5"}) {
        const auto shown = pictured(device, face, millimetres_a_unit, Output::display_srgb,
                                    {{"grain.strength", "0.05"}, {"grain.size", size}});
        if (!shown) return {};
        Variant variant;
        variant.label = std::string("grain.size=") + size;
        const double pixels = std::stod(size);
        variant.work = pixels > 1 ? "4 hashes a pixel" : "1 hash a pixel";
        variant.is_default = !(pixels > 1);
        variant.run = [shown] { shown->draw(); };
        variant.error = [shown, before, pixels] {
            ExactPicture exact = *before;
            for (std::uint32_t y = 0; y < exact.height; ++y) {
                for (std::uint32_t x = 0; x < exact.width; ++x) {
                    const double noise = film_grain_noise(x, y, 0, 0, pixels);
                    for (glm::length_t c = 0; c < 3; ++c) {
                        double& value = exact.at(x, y)[c];
                        value += film_grain_deviation(value, 0.05, pixels) * noise;
                    }
                }
            }
            return percent_of_mean(shown->picture(), exact);
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
