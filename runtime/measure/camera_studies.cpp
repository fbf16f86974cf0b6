#include "runtime/measure/camera_studies.h"
#include "runtime/measure/portrait.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/camera/bloom.h"
#include "rig/camera/depth_of_field.h"
#include "rig/camera/exposure.h"
#include "rig/camera/film_grain.h"
#include "runtime/frame/frame_state.h"
#include "runtime/offscreen.h"

namespace blush {
namespace {

using Picture = Map<glm::dvec3>;
constexpr std::uint32_t side_pixels = 192;

struct Setup {
    std::string name, value;
};

/// A face, a picture of it, and what settings make of it.
struct Shown {
    Portrait character;
    Offscreen offscreen;
    ViewFrame view;

    void draw() {
        character.draw(view);
        glFinish();
    }
    /// Rows from the bottom, as passes see them; of an 8-bit picture 0 to 1.
    Picture picture() {
        draw();
        const Image image = offscreen.read();
        Picture result(image.width, image.height);
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const std::size_t at = 4 * (std::size_t{image.height - 1 - y} * image.width + x);
                for (glm::length_t c = 0; c < 3; ++c) {
                    const std::size_t channel = at + static_cast<std::size_t>(c);
                    result.at(x, y)[c] = image.floats.empty() ? image.bytes[channel] / 255.0
                                                              : static_cast<double>(image.floats[channel]);
                }
            }
        }
        return result;
    }
};

std::shared_ptr<Shown> show(const Device& device, const Face& face, double millimetres_a_unit, Output output,
                            const std::vector<Setup>& settings) {
    Result<Portrait> character = Portrait::create(device, face);
    Result<Offscreen> offscreen = Offscreen::create(device, side_pixels, side_pixels, output);
    if (!character || !offscreen) return nullptr;
    if (!character->set("scattering.millimetres_a_unit", std::to_string(millimetres_a_unit))) return nullptr;
    for (const Setup& setting : settings) {
        if (!character->set(setting.name, setting.value)) return nullptr;
    }
    auto shown = std::make_shared<Shown>(Shown{*std::move(character), *std::move(offscreen), {}});
    shown->view = shown->offscreen.view();
    shown->view.camera = shown->character.framing(1).camera(1);
    return shown;
}

/// Over all pixels and channels, in hundredths of the reference's mean.
Variant::Error percent_of_mean(const Picture& picture, const Picture& reference) {
    Variant::Error error;
    double total = 0;
    for (std::size_t p = 0; p < picture.values.size(); ++p) {
        for (glm::length_t c = 0; c < 3; ++c) {
            const double d = std::abs(picture.values[p][c] - reference.values[p][c]);
            error.mean += d;
            error.worst = std::max(error.worst, d);
            total += reference.values[p][c];
        }
    }
    if (total > 0) {
        error.mean *= 100 / total;
        error.worst *= 100 * 3 * static_cast<double>(picture.values.size()) / total;
    }
    return error;
}

}  // namespace

std::vector<Study> bloom_studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    const auto plain = show(device, face, millimetres_a_unit, Output::linear_hdr, {});
    if (!plain) return {};
    const auto before = std::make_shared<Picture>(plain->picture());
    Study study{"whole frames of 192x192 pixels, bloom of 0.2",
                "the pyramid in double precision on the CPU",
                "% of the mean light",
                {},
                before};
    for (const char* radius : {"0.02", "0.06", "0.2"}) {
        const auto shown = show(device, face, millimetres_a_unit, Output::linear_hdr,
                                {{"bloom.strength", "0.2"}, {"bloom.radius", radius}});
        if (!shown) return {};
        Variant variant;
        variant.label = std::string("bloom.radius=") + radius;
        const std::uint32_t levels = bloom_levels(std::stod(radius), side_pixels, side_pixels);
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

std::vector<Study> exposure_studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    const auto plain = show(device, face, millimetres_a_unit, Output::linear_hdr, {});
    if (!plain) return {};
    const auto before = std::make_shared<Picture>(plain->picture());
    Study study{"whole frames of 192x192 pixels", "log-average in double precision on the CPU", "stops", {}, before};
    for (const char* metering : {"frame", "centre"}) {
        const auto shown = show(device, face, millimetres_a_unit, Output::display_srgb,
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

std::vector<Study> film_grain_studies(const Device& device, const Face& face, double millimetres_a_unit,
                                      bool /*quick*/) {
    const auto plain = show(device, face, millimetres_a_unit, Output::display_srgb, {});
    if (!plain) return {};
    const auto before = std::make_shared<Picture>(plain->picture());
    Study study{"whole frames of 192x192 pixels, grain of 0.05",
                "the noise in double precision on the CPU",
                "% of the mean display value",
                {},
                before};
    for (const char* size : {"1", "2.5"}) {
        const auto shown = show(device, face, millimetres_a_unit, Output::display_srgb,
                                {{"grain.strength", "0.05"}, {"grain.size", size}});
        if (!shown) return {};
        Variant variant;
        variant.label = std::string("grain.size=") + size;
        const double pixels = std::stod(size);
        variant.work = pixels > 1 ? "4 hashes a pixel" : "1 hash a pixel";
        variant.is_default = !(pixels > 1);
        variant.run = [shown] { shown->draw(); };
        variant.error = [shown, before, pixels] {
            Picture exact = *before;
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

std::vector<Study> depth_of_field_studies(const Device& device, const Face& face, double millimetres_a_unit,
                                          bool quick) {
    const auto sharp = show(device, face, millimetres_a_unit, Output::linear_hdr, {});
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
    Picture sum(side_pixels, side_pixels, glm::dvec3(0));
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
        const Picture picture = sharp->picture();
        for (std::size_t p = 0; p < sum.values.size(); ++p) sum.values[p] += picture.values[p];
    }
    for (glm::dvec3& c : sum.values) c /= static_cast<double>(places.size());
    const auto reference = std::make_shared<Picture>(std::move(sum));

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
        const auto shown = show(device, face, millimetres_a_unit, Output::linear_hdr,
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
