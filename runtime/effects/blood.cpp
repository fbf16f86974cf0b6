/// Blood: the colour of skin follows its hemoglobin (jimenez-2012, chapter 7).

#include <algorithm>
#include <array>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/frame/frame.h"

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

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.asset.appearance().pigments) {
        return {.on = false,
                .reason = "the face has no maps of melanin and hemoglobin (blush bake appearance makes them)",
                .can_be_forced = false};
    }
    if (is_hidden(character.settings, "blood")) {
        return {.on = false, .reason = "blood.shown says no", .can_be_forced = false};
    }
    if (colour_from_pigments(character)) return {.on = true, .reason = "blood.colour says pigments"};
    const bool neutral = std::ranges::all_of(character.pose.hemoglobin, [](float share) { return share == 0; });
    if (neutral && character.pose.hemoglobin_factor == 1) {
        return {.on = false, .reason = "the blood is as it is at rest: the skin has the colour of its texture"};
    }
    return {.on = true, .reason = "some expression or state moves blood"};
}

bool blends(const FrameState& frame, CharacterState& character) {
    return character.on(blood_effect) &&
           (frame.facts.forced || blended_blood(character).shares != character.pose.hemoglobin);
}

void declare(FrameState& frame) {
    bool any = false;
    for (CharacterState* character : frame.characters) {
        if (!character->on(blood_effect)) continue;
        const BloodTextures& textures = blood_textures(*character);
        character->resources.blood_change =
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
        if (blends(frame, *character)) frame.graph.writes(character->resources.blood_change);
    }
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"face without maps of its pigments", "is drawn as it is", [](Face& /*face*/) {}},
}};

}  // namespace

const Effect blood_effect = {
    .name = "blood",
    .what = "skin takes the colour of the blood in it",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
