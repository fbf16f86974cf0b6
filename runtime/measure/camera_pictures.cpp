#include "runtime/measure/camera_pictures.h"

#include <algorithm>
#include <cmath>

#include <epoxy/gl.h>

namespace blush {

void PicturedFace::draw() {
    character.draw(view);
    glFinish();
}

ExactPicture PicturedFace::picture() {
    draw();
    const Image image = offscreen.read();
    ExactPicture result(image.width, image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::size_t at = 4 * (std::size_t{image.height - 1 - y} * image.width + x);
            for (glm::length_t c = 0; c < 3; ++c) {
                const std::size_t channel = at + static_cast<std::size_t>(c);
                result.at(x, y)[c] =
                    image.floats.empty() ? image.bytes[channel] / 255.0 : static_cast<double>(image.floats[channel]);
            }
        }
    }
    return result;
}

std::shared_ptr<PicturedFace> pictured(const Device& device, const Face& face, double millimetres_a_unit, Output output,
                                       const std::vector<NamedValue>& settings) {
    constexpr std::uint32_t side = PicturedFace::side_pixels;
    Result<Portrait> character = Portrait::create(device, face);
    Result<Offscreen> offscreen = Offscreen::create(device, side, side, output);
    if (!character || !offscreen) return nullptr;
    if (!character->set("scattering.millimetres_a_unit", std::to_string(millimetres_a_unit))) return nullptr;
    for (const NamedValue& setting : settings) {
        if (!character->set(setting.setting, setting.value)) return nullptr;
    }
    auto shown = std::make_shared<PicturedFace>(PicturedFace{*std::move(character), *std::move(offscreen), {}});
    shown->view = shown->offscreen.view();
    shown->view.camera = shown->character.framing(1).camera(1);
    return shown;
}

Variant::Error percent_of_mean(const ExactPicture& picture, const ExactPicture& reference) {
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

}  // namespace blush
