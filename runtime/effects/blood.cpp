/// Blood: the colour of skin follows its hemoglobin (jimenez-2012, chapter 7).

#include <algorithm>
#include <array>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush::shared {
#include "shaders/blood/blood_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> colours = {"texture", "pigments"};
constexpr std::array<Setting, 3> settings = {{
    shown_setting("yes: where the pose moves blood; no: never"),
    {"colour",
     "texture: the face's own texture, and what blood changes of it; pigments: the maps of melanin, hemoglobin and "
     "residual alone, in every frame",
     colours},
    {.name = "table_nodes",
     .meaning = "nodes of a side of the table of skin's colour",
     .lowest = 2,
     .highest = 512,
     .default_number = 64},
}};
using Own = OwnSetting<blood_effect, settings>;

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.asset.appearance().pigments) {
        return {.on = false,
                .reason = "the face has no maps of melanin and hemoglobin (blush bake appearance makes them)",
                .can_be_forced = false};
    }
    if (character.settings.choice(Own("shown")) == 1) {
        return {.on = false, .reason = "blood.shown says no", .can_be_forced = false};
    }
    if (colour_from_pigments(character)) return {.on = true, .reason = "blood.colour says pigments"};
    const bool neutral = std::ranges::all_of(character.pose.hemoglobin, [](float share) { return share == 0; });
    if (neutral && character.pose.hemoglobin_factor == 1) {
        return {.on = false, .reason = "the blood is as it is at rest: the skin has the colour of its texture"};
    }
    return {.on = true, .reason = "some expression or state moves blood"};
}

/// What "blend blood" writes, in the frame being drawn.
struct Change {
    ResourceId id{};
};

bool blends(const FrameState& frame, CharacterState& character) {
    return character.on(blood_effect) &&
           (frame.facts.forced || blended_blood(character).shares != character.pose.hemoglobin);
}

void declare(FrameState& frame) {
    bool any = false;
    for (CharacterState* character : frame.characters) {
        if (!character->on(blood_effect)) continue;
        const BloodTextures& textures = blood_textures(*character);
        character->own<Change>().id =
            frame.graph.import_texture("blood", blended_blood(*character).texture.name(), textures.blended_shape);
        any |= blends(frame, *character);
    }
    if (!any) return;
    const auto blend_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (blends(frame, *character)) blend_blood(frame, *character);
        }
    };
    frame.graph.pass("blend blood", blend_all);
    for (CharacterState* character : frame.characters) {
        if (blends(frame, *character)) frame.graph.writes(character->own<Change>().id);
    }
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"face without maps of its pigments", "is drawn as it is", [](Face& /*face*/) {}},
}};

std::uint32_t variant(const FrameState& /*frame*/, const CharacterState& character) {
    return colour_from_pigments(character) ? 1 : 0;
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::BloodUniforms*>(to);
    out.factor = character.pose.hemoglobin_factor;
    out.largest = static_cast<float>(largest_hemoglobin);
    out.table_nodes = static_cast<float>(blood_textures(character).table_nodes);
}

void bind(FrameState& /*frame*/, CharacterState& character, std::uint32_t unit) {
    const BloodTextures& textures = blood_textures(character);
    glBindTextureUnit(unit, textures.pigments.name());
    glBindTextureUnit(unit + 1, blended_blood(character).texture.name());
    glBindTextureUnit(unit + 2, textures.table.name());
    if (colour_from_pigments(character)) glBindTextureUnit(unit + 3, textures.residual.name());
}

void reads(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        if (character->on(blood_effect)) frame.graph.reads(character->own<Change>().id);
    }
}

constexpr std::array<std::string_view, 1> hooks = {"colour"};
constexpr std::array<ShadingVariant, 1> variants = {{{"PIGMENT_COLOR", 1}}};
constexpr std::array<UniformField, 3> fields = {{{"factor", offsetof(shared::BloodUniforms, factor)},
                                                 {"largest", offsetof(shared::BloodUniforms, largest)},
                                                 {"table_nodes", offsetof(shared::BloodUniforms, table_nodes)}}};
constexpr ShadingPart shading = {
    .file = "blood/blood.glsl",
    .hooks = hooks,
    .materials = materials_of(MaterialKind::skin),
    .variants = variants,
    .variant = variant,
    .uniforms = {"blood/blood_uniforms.glsl", "BloodUniforms", sizeof(shared::BloodUniforms), fields, write},
    .textures = 3,
    .bind = bind,
    .reads = reads,
};

}  // namespace

constinit const SettingId blood_colour = Own("colour");
constinit const SettingId blood_table_nodes = Own("table_nodes");

const Effect blood_effect = {
    .name = "blood",
    .what = "skin takes the colour of the blood in it",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .declare = declare,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
