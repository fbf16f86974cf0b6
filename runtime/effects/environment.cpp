/// Light from all around (chappuis-2011, chapter 3). Shading does it.

#include <array>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"

namespace blush {
namespace {

Need need(const FrameState& frame) {
    if (frame.lighting->environment == nullptr) {
        return {.on = false, .reason = "the lighting has no environment", .can_be_forced = false};
    }
    return {.on = true, .reason = "the lighting has an environment"};
}

const Lighting& lighting_of(float value) {
    const auto make = [](float radiance) {
        Image image;
        image.width = 8;
        image.height = 4;
        image.channels = 3;
        image.floats.assign(8 * 4 * 3, radiance);
        Lighting lighting;
        if (auto environment = make_environment(image)) lighting.environment = *environment;
        return lighting;
    };
    static const Lighting black = make(0), nan = make(std::numeric_limits<float>::quiet_NaN()), bright = make(1e30F);
    return value == 0 ? black : value > 0 ? bright : nan;
}

constexpr std::array<HardCase, 3> hard_cases = {{
    {"an all-black environment", "a black face", [](Face&) {}, 0,
     [](ViewFrame& view) { view.lighting = &lighting_of(0); }},
    {"an environment of NaN", "counts as black", [](Face&) {}, 0,
     [](ViewFrame& view) { view.lighting = &lighting_of(-1); }},
    {"an environment beyond half precision", "limited to what a half float holds", [](Face&) {}, 0,
     [](ViewFrame& view) { view.lighting = &lighting_of(1); }},
}};

}  // namespace

const Effect environment_effect = {
    .name = "environment",
    .what = "a radiance map lights the face from all around",
    .settings = {},
    .stage = Stage::light,
    .need = need,
    .hard_cases = hard_cases,
};

}  // namespace blush
