/// Light from all around (chappuis-2011, chapter 3). Shading does it.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/environment_map.h"

namespace blush::shared {
#include "shaders/light/environment_uniforms.glsl"
}  // namespace blush::shared

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

void write(const FrameState& frame, CharacterState& /*character*/, void* to) {
    const EnvironmentView view = environment_view(*frame.lighting);
    auto& out = *static_cast<shared::EnvironmentUniforms*>(to);
    out.factor = view.factor;
    out.last_level = static_cast<float>(frame.lighting->environment->levels.size()) - 1;
    out.turn = view.turn_radians;
}

void bind(FrameState& frame, CharacterState& /*character*/, std::uint32_t unit) { bind_environment(frame, unit); }

constexpr std::array<std::string_view, 1> hooks = {"ambient"};
constexpr std::array<UniformField, 3> fields = {{{"factor", offsetof(shared::EnvironmentUniforms, factor)},
                                                 {"last_level", offsetof(shared::EnvironmentUniforms, last_level)},
                                                 {"turn", offsetof(shared::EnvironmentUniforms, turn)}}};
constexpr ShadingPart shading = {
    .file = "light/environment.glsl",
    .hooks = hooks,
    .uniforms = {"light/environment_uniforms.glsl", "EnvironmentUniforms", sizeof(shared::EnvironmentUniforms), fields,
                 write},
    .textures = 1,
    .bind = bind,
};

}  // namespace

const Effect environment_effect = {
    .name = "environment",
    .what = "a radiance map lights the face from all around",
    .settings = {},
    .stage = Stage::light,
    .need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
