/// Light from all around reaches nostrils, lids and the inside of a mouth only so far as the face lets it
/// (chappuis-2011, 3.3). Shading does it, by coefficients that `blush bake occlusion` made.

#include <array>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> method_choices = {"baked", "off"};
constexpr std::array<std::string_view, 2> bounce_choices = {"on", "off"};
constexpr std::array<Setting, 2> settings = {{
    {"method", "baked: by nine coefficients a vertex; off: nothing hides ambient light", method_choices, 0},
    {"bounces", "on: what hides a place shines as the place itself does; off: it is black", bounce_choices, 0},
}};

Need need(const FrameState& frame, const CharacterState& character) {
    if (!character.facts_of_face.occlusion) {
        return {.on = false, .reason = "no coefficients were baked for the face", .can_be_forced = false};
    }
    if (character.settings.choice("occlusion", "method") == 1) {
        return {.on = false, .reason = "occlusion.method is off", .can_be_forced = false};
    }
    const Lighting& lighting = *frame.lighting;
    if (lighting.environment == nullptr && lighting.sky_radiance_linear == glm::vec3(0) &&
        lighting.ground_radiance_linear == glm::vec3(0)) {
        return {.on = false, .reason = "no light comes from all around"};
    }
    return {.on = true, .reason = "light comes from all around, and the face hides some of it from itself"};
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a face without coefficients", "lit as if it hid nothing", [](Face&) {}},
}};

}  // namespace

const Effect occlusion_effect = {
    .name = "occlusion",
    .what = "the face hides light from all around from itself",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .hard_cases = hard_cases,
};

}  // namespace blush
