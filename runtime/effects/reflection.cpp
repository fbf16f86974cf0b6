/// Reflection at the surface of skin (chappuis-2011, 2.3 and 2.6). Shading does it.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/skin_tables.h"

namespace blush::shared {
#include "shaders/light/reflection_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> model_choices = {"kelemen", "ggx"};
constexpr std::array<Setting, 3> settings = {{
    {"model",
     "kelemen: Kelemen/Szirmay-Kalos with Beckmann's distribution, and light inside is what the surface leaves; ggx: "
     "the "
     "metallic-roughness model of the other materials",
     model_choices, 0},
    {"roughness",
     "Beckmann's m of skin whose material has roughness 0.5; others in proportion",
     {},
     0,
     0.08,
     0.95,
     0.3},
    {"intensity", "factor on the surface's reflection; 0: all light enters", {}, 0, 0, 1, 1},
}};
using Own = OwnSetting<reflection_effect, settings>;

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (character.facts_of_face.skin.parts.empty())
        return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    if (character.settings.choice(Own("model")) == 1) {
        return {.on = false, .reason = "reflection.model is ggx", .can_be_forced = false};
    }
    if (!character.skin.on_screen) return {.on = false, .reason = "no skin is on the screen"};
    return {.on = true, .reason = "skin is on the screen"};
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"roughness of 0 and of 1", "finite highlights",
     [](Face& face) {
         for (Material& material : face.materials) material.roughness = 0;
         face.materials.push_back(face.materials[0]);
         face.materials.back().roughness = 1;
     }},
}};

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::ReflectionUniforms*>(to);
    out.roughness = static_cast<float>(character.settings.number(Own("roughness")));
    out.intensity = static_cast<float>(character.settings.number(Own("intensity")));
}

void bind(FrameState& frame, CharacterState& /*character*/, std::uint32_t unit) {
    const SkinTables& tables = skin_tables(frame);
    glBindTextureUnit(unit, tables.beckmann.name());
    glBindTextureUnit(unit + 1, tables.specular_albedo.name());
}

constexpr std::array<std::string_view, 2> hooks = {"split", "around"};
constexpr std::array<UniformField, 2> fields = {{{"roughness", offsetof(shared::ReflectionUniforms, roughness)},
                                                 {"intensity", offsetof(shared::ReflectionUniforms, intensity)}}};
constexpr ShadingPart shading = {
    .file = "light/skin_reflection.glsl",
    .hooks = hooks,
    .materials = materials_of(MaterialKind::skin),
    .uniforms = {"light/reflection_uniforms.glsl", "ReflectionUniforms", sizeof(shared::ReflectionUniforms), fields,
                 write},
    .textures = 2,
    .bind = bind,
};

}  // namespace

const Effect reflection_effect = {
    .name = "reflection",
    .what = "skin's oily surface mirrors light and lets the rest in",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
