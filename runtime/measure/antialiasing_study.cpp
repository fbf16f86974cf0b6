#include "runtime/measure/antialiasing_study.h"
#include "runtime/measure/portrait.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <epoxy/gl.h>

#include "runtime/offscreen.h"

namespace blush {
namespace {

constexpr std::uint32_t side_pixels = 256;

/// A character of its own for each way to sample, so that none pays for the settings of another.
struct Studied {
    Studied(const Device& on, const Face& of, Offscreen into) : device(on), face(of), offscreen(std::move(into)) {}

    Device device;
    Face face;
    Offscreen offscreen;
    std::vector<std::optional<Portrait>> characters;  // of each mode, made when first run
    Image reference;

    Portrait* make() {
        Result<Portrait> made = Portrait::create(device, face);
        if (!made) return nullptr;
        // A dozen of targets: a usual frame.
        const std::size_t active = std::min<std::size_t>(12, face.targets.size());
        std::fill_n(made->controls().begin(), active, 0.5F);
        scratch.emplace(*std::move(made));
        return &*scratch;
    }
    ViewFrame view(Portrait& character) const {
        ViewFrame view = offscreen.view();
        view.camera = character.framing(1).camera(1);
        return view;
    }
    void draw(Portrait& character, int frames) const {
        ViewFrame frame = view(character);
        frame.cut = true;
        for (int f = 0; f < frames; ++f) {
            character.draw(frame);
            frame.cut = false;
        }
        glFinish();
    }
    void find_reference() {
        if (!reference.bytes.empty()) return;
        Portrait* character = make();
        if (character == nullptr || !character->set("antialiasing.mode", "supersampled") ||
            !character->set("supersampling.factor", "8")) {
            return;
        }
        draw(*character, 1);
        reference = offscreen.read();
    }

    std::optional<Portrait> scratch;
};

/// Of display values, of 255: the mean over all pixels, and the worst. A difference of one is left out: means of
/// rounded pictures round otherwise than one picture does.
Variant::Error error_of(const Image& image, const Image& reference) {
    Variant::Error error;
    double pixels = 0;
    for (std::size_t p = 0; p + 3 < image.bytes.size(); p += 4) {
        double difference = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            difference = std::max(difference, std::abs(static_cast<double>(image.bytes[p + c]) -
                                                       static_cast<double>(reference.bytes[p + c])));
        }
        if (difference > 1) error.mean += difference;
        error.worst = std::max(error.worst, difference);
        pixels += 1;
    }
    error.mean /= std::max(pixels, 1.0);
    return error;
}

}  // namespace

std::vector<Study> antialiasing_studies(const Device& device, const Face& face, std::span<const StudiedMode> modes) {
    Result<Offscreen> offscreen = Offscreen::create(device, side_pixels, side_pixels, Output::display_srgb);
    if (!offscreen) return {};
    auto kept = std::make_shared<Studied>(device, face, *std::move(offscreen));
    kept->characters.resize(modes.size());
    Study study{"a frame of 256x256, " + std::to_string(face.positions.size()) + " vertices",
                "the mean of 64 pictures, each drawn from its own place in the pixel",
                "of 255",
                {},
                kept};
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const StudiedMode mode = modes[m];
        const auto draw = [kept, m, mode] {
            std::optional<Portrait>& character = kept->characters[m];
            if (!character) {
                if (kept->make() == nullptr) return;
                character = std::exchange(kept->scratch, std::nullopt);
                if (!character->set("antialiasing.mode", mode.mode)) return;
                if (!mode.setting.empty() && !character->set(mode.setting, mode.choice)) return;
            }
            kept->draw(*character, mode.frames);
        };
        Variant variant;
        variant.label = std::string(mode.label);
        variant.work = std::string(mode.work);
        variant.is_default = mode.is_default;
        variant.run = draw;
        variant.error = [kept, draw] {
            kept->find_reference();
            draw();
            return kept->reference.bytes.empty() ? Variant::Error{} : error_of(kept->offscreen.read(), kept->reference);
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

}  // namespace blush
