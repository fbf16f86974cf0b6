/// Depth of field beside a real lens: the mean of pictures from many places of its opening (Haeberli and Akeley
/// 1990).

#include <glm/gtc/matrix_transform.hpp>

#include "rig/camera/depth_of_field.h"
#include "runtime/frame/frame_state.h"
#include "runtime/measure/camera_pictures.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::depth_of_field(const Device& device, const Face& face, double millimetres_a_unit,
                                           bool quick) {
    const auto sharp = pictured(device, face, millimetres_a_unit, Output::linear_hdr, {});
    if (!sharp) return {};
    // Focused on the middle of the face, so that the reference needs nothing of the effect's own.
    const CharacterState& state = sharp->character.state();
    const Camera camera = sharp->view.camera;
    const double focus_mm =
        -(camera.view_from_world * glm::dvec4(state.facts_of_face.bounds.centre(), 1)).z * millimetres_a_unit;
    constexpr double f_number = 1.4, sensor_mm = 24;
    const double focal_length_mm = 0.5 * sensor_mm * static_cast<double>(camera.clip_from_view[1][1]);
    const double lens_radius = 0.5 * focal_length_mm / f_number / millimetres_a_unit;
    sharp->draw();
    const Lighting fixed = sharp->character.frame().portrait;  // the lights of a portrait would follow the camera
    sharp->view.lighting = &fixed;
    ExactPicture sum(PicturedFace::side_pixels, PicturedFace::side_pixels, glm::dvec3(0));
    const std::vector<glm::vec2> places = blur_taps(quick ? 16 : 64);
    for (const glm::vec2 place : places) {
        // The camera moves over the lens; its projection is sheared so that the focal plane stays where it is.
        const glm::vec2 off = place * static_cast<float>(lens_radius);
        const float focus = static_cast<float>(focus_mm / millimetres_a_unit);
        sharp->view.camera.view_from_world =
            glm::translate(glm::dmat4(1), glm::dvec3(-off, 0)) * camera.view_from_world;
        sharp->view.camera.clip_from_view = camera.clip_from_view;
        sharp->view.camera.clip_from_view[2][0] -= camera.clip_from_view[0][0] * off.x / focus;
        sharp->view.camera.clip_from_view[2][1] -= camera.clip_from_view[1][1] * off.y / focus;
        const ExactPicture picture = sharp->picture();
        for (std::size_t p = 0; p < sum.values.size(); ++p) sum.values[p] += picture.values[p];
    }
    for (glm::dvec3& c : sum.values) c /= static_cast<double>(places.size());
    const auto reference = std::make_shared<ExactPicture>(std::move(sum));

    Study study{"whole frames of 192x192 pixels at f/1.4, focused on the middle of the head",
                "the mean of " + std::to_string(places.size()) + " pictures from all over the lens's opening",
                "% of the mean light",
                {},
                reference};
    struct Kind {
        const char *label, *f_number, *samples;
    };
    for (const Kind kind :
         {Kind{"depth_of_field.f_number=0", "0", "49"}, Kind{"depth_of_field.samples=25", "1.4", "25"},
          Kind{"depth_of_field.samples=49", "1.4", "49"}, Kind{"depth_of_field.samples=81", "1.4", "81"}}) {
        const auto shown = pictured(device, face, millimetres_a_unit, Output::linear_hdr,
                                    {{"depth_of_field.f_number", kind.f_number},
                                     {"depth_of_field.samples", kind.samples},
                                     {"depth_of_field.focus_mm", std::to_string(focus_mm)},
                                     {"depth_of_field.largest_radius", "0.1"}});
        if (!shown) return {};
        Variant variant;
        variant.label = kind.label;
        variant.work = std::string_view(kind.f_number) == "0" ? "none" : std::string(kind.samples) + " taps a pixel";
        variant.is_default = variant.label == "depth_of_field.samples=49";
        variant.run = [shown] { shown->draw(); };
        variant.error = [shown, reference] { return percent_of_mean(shown->picture(), *reference); };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
