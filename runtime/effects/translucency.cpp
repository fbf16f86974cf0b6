/// Light through thin parts: ears and nostrils (jimenez-2012, chapter 5). Shading adds it to the light that scatters.

#include <array>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/shadow_maps.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> attenuation_choices = {"derived", "printed"};
constexpr std::array<Setting, 3> settings = {{
    {"strength", "factor on the light that passes; 0: off", {}, 0, 0, 4, 1},
    {"attenuation",
     "derived: T(s) as it follows from the profile; printed: as eq. 5.12 and listing 5.1 have it, as if skin were "
     "thicker by a factor of the square root of 2",
     attenuation_choices, 0},
    {"drawn_in_mm", "how far a point is drawn in along its normal before its depth is looked up (5.5)", {}, 0, 0, 5, 1},
}};

Need need(const FrameState& frame, const CharacterState& character) {
    if (character.facts_of_face.skin.parts.empty())
        return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    if (character.settings.number("translucency", "strength") == 0) {
        return {.on = false, .reason = "translucency.strength is 0", .can_be_forced = false};
    }
    if (frame.scene->settings.choice("shadows", "method") == 1 || character.shadow_lights == 0) {
        return {.on = false, .reason = "no light has a shadow map to tell a thickness from", .can_be_forced = false};
    }
    if (!character.skin.on_screen) return {.on = false, .reason = "no skin is on the screen"};
    return {.on = true, .reason = "a light with a shadow map may stand behind thin skin"};
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a sheet without thickness", "bright, and finite",
     [](Face& face) {
         for (glm::vec3& position : face.positions) position.z = 0;
     }},
}};

}  // namespace

const Effect translucency_effect = {
    .name = "translucency",
    .what = "light passes thin parts such as ears",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .hard_cases = hard_cases,
};

}  // namespace blush
