/// Light through thin parts: ears and nostrils (jimenez-2012, chapter 5). Shading adds it to the light that scatters.

#include <array>
#include <cmath>

#include "runtime/effects/effects.h"
#include "runtime/effects/scattering.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/shadow_maps.h"

namespace blush::shared {
#include "shaders/light/translucency_uniforms.glsl"
}  // namespace blush::shared

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
using Own = OwnSetting<translucency_effect, settings>;

Need need(const FrameState& frame, const CharacterState& character) {
    if (character.facts_of_face.skin.parts.empty())
        return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    if (character.settings.number(Own("strength")) == 0) {
        return {.on = false, .reason = "translucency.strength is 0", .can_be_forced = false};
    }
    if (frame.scene->settings.choice(shadows_method) == 1 || character.shadow_lights == 0) {
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

/// T(s) of the material: jimenez-2012, eq. 5.12, as it follows from the profile or as it is printed.
void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::TranslucencyUniforms*>(to);
    out.strength = static_cast<float>(character.settings.number(Own("strength")));
    out.drawn_in_mm = static_cast<float>(character.settings.number(Own("drawn_in_mm")));
    const std::span<const GaussianTerm> profile = scatter_profile(character);
    const bool derived = character.settings.choice(Own("attenuation")) == 0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const double exponent = -1 / ((derived ? 2 : 1) * profile[k].variance_mm2);
        out.profile[k] = glm::vec4(glm::vec3(profile[k].weight), static_cast<float>(exponent));
    }
    // Four standard deviations of the widest: less than a thousandth of anything passes.
    out.thickest_mm = static_cast<float>(4 * std::sqrt(profile.back().variance_mm2));
}

constexpr std::array<std::string_view, 1> hooks = {"through"};
constexpr std::array<UniformField, 4> fields = {{{"strength", offsetof(shared::TranslucencyUniforms, strength)},
                                                 {"drawn_in_mm", offsetof(shared::TranslucencyUniforms, drawn_in_mm)},
                                                 {"thickest_mm", offsetof(shared::TranslucencyUniforms, thickest_mm)},
                                                 {"profile[0]", offsetof(shared::TranslucencyUniforms, profile)}}};
constexpr ShadingPart shading = {
    .file = "light/translucency.glsl",
    .hooks = hooks,
    .builds_on = &shadows_effect,
    .materials = materials_of(MaterialKind::skin),
    .uniforms = {"light/translucency_uniforms.glsl", "TranslucencyUniforms", sizeof(shared::TranslucencyUniforms),
                 fields, write},
};

}  // namespace

const Effect translucency_effect = {
    .name = "translucency",
    .what = "light passes thin parts such as ears",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
