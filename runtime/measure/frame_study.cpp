#include "runtime/measure/frame_study.h"
#include "runtime/measure/portrait.h"

#include <algorithm>
#include <cmath>

#include "runtime/frame/character_state.h"
#include "runtime/offscreen.h"

namespace blush {
namespace {

struct Drawn {
    Portrait character;
    Offscreen offscreen;
    ViewFrame view;

    void draw() {
        character.draw(view);
        glFinish();
    }
};

std::shared_ptr<Drawn> make_drawn(const Device& device, const Face& face, double millimetres_a_unit,
                                  const FrameStudy& what, const std::string& value) {
    constexpr std::uint32_t side_pixels = 192;
    Result<Portrait> character = Portrait::create(device, face);
    Result<Offscreen> offscreen = Offscreen::create(device, side_pixels, side_pixels, Output::linear_hdr);
    if (!character || !offscreen) return nullptr;
    if (!character->set("scattering.millimetres_a_unit", std::to_string(millimetres_a_unit))) return nullptr;
    if (!character->set(what.setting, value)) return nullptr;
    auto drawn = std::make_shared<Drawn>(Drawn{*std::move(character), *std::move(offscreen), {}});
    drawn->view = drawn->offscreen.view();
    drawn->view.camera = drawn->character.framing(1).camera(1);
    drawn->view.camera.clip_from_view[0] *= what.nearness;
    drawn->view.camera.clip_from_view[1] *= what.nearness;
    drawn->view.lighting = what.lighting;
    return drawn;
}

Variant::Error difference(const Image& image, const Image& reference) {
    Variant::Error error;
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < image.floats.size(); ++i) {
        if (i % 4 == 3) continue;
        const double d = std::abs(static_cast<double>(image.floats[i]) - static_cast<double>(reference.floats[i]));
        error.mean += d;
        error.worst = std::max(error.worst, d);
        sum += static_cast<double>(reference.floats[i]);
        ++count;
    }
    if (sum > 0) {
        error.mean *= 100 / sum;
        error.worst *= 100 * count / sum;
    }
    return error;
}

}  // namespace

std::vector<Study> frame_study(const Device& device, const Face& face, double millimetres_a_unit,
                               const FrameStudy& what) {
    const std::shared_ptr<Drawn> reference = make_drawn(device, face, millimetres_a_unit, what, what.reference_value);
    if (!reference) return {};
    reference->draw();
    const auto picture = std::make_shared<Image>(reference->offscreen.read());
    Study study{"whole frames of 192x192 pixels, nothing moving",
                "the frame with " + what.setting + "=" + what.reference_value,
                "% of the mean light",
                {},
                picture};
    for (std::size_t v = 0; v < what.values.size(); ++v) {
        const std::shared_ptr<Drawn> drawn = make_drawn(device, face, millimetres_a_unit, what, what.values[v]);
        if (!drawn) return {};
        Variant variant;
        variant.label = what.setting + "=" + what.values[v];
        variant.is_default = v == what.default_value;
        drawn->draw();
        variant.work = std::to_string(drawn->character.report().triangles_drawn) + " triangles at first";
        variant.run = [drawn] { drawn->draw(); };
        variant.error = [drawn, picture] {
            drawn->draw();
            return difference(drawn->offscreen.read(), *picture);
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

const Lighting& study_backlight() {
    static const Lighting lighting = [] {
        Lighting made;
        LightSource behind, front;
        behind.direction_world = {-0.4F, -0.2F, 0.9F};
        behind.radiance_linear = glm::vec3(5);
        behind.size = front.size = 0.0625F;
        front.direction_world = {0.3F, -0.3F, -1};
        front.radiance_linear = glm::vec3(0.8F);
        made.lights = {behind, front};
        made.sky_radiance_linear = made.ground_radiance_linear = glm::vec3(0.05F);
        return made;
    }();
    return lighting;
}

}  // namespace blush
