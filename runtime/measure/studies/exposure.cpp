/// Automatic exposure, against the log-average in double precision.

#include <cmath>

#include "rig/camera/exposure.h"
#include "runtime/frame/frame_state.h"
#include "runtime/measure/camera_pictures.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::exposure(const Device& device, const Face& face, double millimetres_a_unit,
                                     bool /*quick*/) {
    const auto plain = pictured(device, face, millimetres_a_unit, Output::linear_hdr, {});
    if (!plain) return {};
    const auto before = std::make_shared<ExactPicture>(plain->picture());
    Study study{"whole frames of 192x192 pixels", "log-average in double precision on the CPU", "stops", {}, before};
    for (const char* metering : {"frame", "centre"}) {
        const auto shown = pictured(device, face, millimetres_a_unit, Output::display_srgb,
                                    {{"exposure.mode", "automatic"}, {"exposure.metering", metering}});
        if (!shown) return {};
        Variant variant;
        variant.label = std::string("exposure.metering=") + metering;
        const Metering how = std::string_view(metering) == "frame" ? Metering::frame : Metering::centre;
        variant.work = "36,864 pixels, each once";
        variant.is_default = how == Metering::frame;
        variant.run = [shown] { shown->draw(); };
        variant.error = [shown, before, how] {
            shown->draw();
            const FrameState& state = shown->character.frame();
            float found = 0;
            glGetTextureImage(state.graph[*state.resources.log2_exposure].handle, 0, GL_RED, GL_FLOAT, sizeof(found),
                              &found);
            const double exact = log2_exposure(log2_average_luminance(*before, how), 0.18, 0, 6);
            const double error = std::abs(static_cast<double>(found) - exact);
            return Variant::Error{error, error};
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
