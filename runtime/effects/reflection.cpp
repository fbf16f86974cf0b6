/// Reflection at the surface of skin (chappuis-2011, 2.3 and 2.6). Shading does it.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/skin_tables.h"
#include "runtime/measure/frame_study.h"
#include "runtime/measure/sphere_study.h"

#include <cmath>
#include <numbers>

#include "rig/light/skin_reflectance.h"

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

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (character.facts_of_face.skin.parts.empty())
        return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    if (character.settings.choice("reflection", "model") == 1) {
        return {.on = false, .reason = "reflection.model is ggx", .can_be_forced = false};
    }
    if (!character.skin.on_screen) return {.on = false, .reason = "no skin is on the screen"};
    return {.on = true, .reason = "skin is on the screen"};
}

const Lighting& one_lamp() {
    static const Lighting lighting = [] {
        Lighting made;
        LightSource lamp;
        lamp.direction_world = {-0.5F, -0.4F, -0.8F};
        made.lights = {lamp};
        return made;
    }();
    return lighting;
}

/// White skin under one_lamp(), without a table: what the surface mirrors, and
/// what it lets in and out again (chappuis-2011, 2.3 and 2.6).
glm::dvec3 exactly_reflected(glm::dvec3 n, double intensity) {
    const glm::dvec3 l = -glm::normalize(glm::dvec3(one_lamp().lights[0].direction_world)), v(0, 0, 1);
    const double n_l = glm::dot(n, l), n_v = n.z, m = sphere_roughness;
    if (n_l <= 0) return glm::dvec3(0);
    const glm::dvec3 h = l + v, unit = glm::normalize(h);
    const double mirrored =
        std::numbers::pi * skin_specular(glm::dot(n, unit), glm::dot(v, unit), glm::dot(h, h), m) * n_l;
    static const double mean = skin_specular_albedo_mean(sphere_roughness);
    const double in = 1 - intensity * skin_specular_albedo(n_l, m, 64);
    const double out = (1 - intensity * skin_specular_albedo(n_v, m, 64)) / (1 - intensity * mean);
    return glm::dvec3(intensity * mirrored + in * n_l * out);
}

std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    std::vector<Study> result =
        sphere_study(device, "a white sphere under one lamp",
                     "the reflectance computed in double precision without "
                     "tables (rig/light/skin_reflectance.h)",
                     one_lamp(),
                     {{"reflection.model", "kelemen", true, [](glm::dvec3 n) { return exactly_reflected(n, 1); }},
                      {"reflection.intensity", "0", false, [](glm::dvec3 n) { return exactly_reflected(n, 0); }},
                      {"reflection.model", "ggx", false, [](glm::dvec3 n) { return exactly_reflected(n, 1); }}});
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"reflection.model", {"kelemen", "ggx"}, 0, "kelemen", nullptr})) {
        result.push_back(std::move(study));
    }
    return result;
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
    out.roughness = static_cast<float>(character.settings.number("reflection", "roughness"));
    out.intensity = static_cast<float>(character.settings.number("reflection", "intensity"));
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
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
