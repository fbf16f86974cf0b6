/// Wrinkles: normals that fold where the pose presses the skin together (jimenez-2012, chapter 8).

#include <algorithm>
#include <array>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/frame/effect.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> encodings = {"derivatives", "differences"};
constexpr std::array<std::string_view, 3> storages = {"compressed", "plain", "half_float"};
constexpr std::array<Setting, 4> settings = {{
    shown_setting("yes: where the pose wrinkles the skin; no: never"),
    {"encoding",
     "derivatives: partial derivatives, which add up as heights do; differences: differences of normals, which are "
     "right "
     "at full weight only",
     encodings},
    {"storage",
     "compressed: RGTC2, one byte a texel; plain: two bytes; half_float: four, for comparison (differences need three "
     "channels, so that for them compressed is plain)",
     storages},
    {.name = "least_pixels_a_mm",
     .meaning = "size on the screen, in pixels a millimetre of skin, below which wrinkles are left out",
     .lowest = 0,
     .highest = 100,
     .default_number = 0.06},
}};

bool any_wrinkle(const CharacterState& character) {
    return std::ranges::any_of(character.pose.wrinkles, [](float weight) { return weight != 0; });
}

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.asset.appearance().wrinkles) {
        return {.on = false,
                .reason = "the face has no wrinkle maps (blush bake wrinkles makes them)",
                .can_be_forced = false};
    }
    if (is_hidden(character.settings, "wrinkles")) {
        return {.on = false, .reason = "wrinkles.shown says no", .can_be_forced = false};
    }
    if (!any_wrinkle(character)) return {.on = false, .reason = "no zone of the face is pressed together or smoothed"};
    if (character.skin.pixels_a_mm < character.settings.number("wrinkles", "least_pixels_a_mm")) {
        return {.on = false,
                .reason = "the face is so small on the screen that a fold is narrower than a pixel",
                .omission = Omission::bounded,
                .bound = 2,
                .bound_unit = "CIEDE2000 of any pixel"};
    }
    return {.on = true, .reason = "some zone of the face is pressed together or smoothed"};
}

void declare(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        if (character->on(wrinkles_effect)) wrinkle_textures(*character);
    }
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"face without maps", "is drawn as it is", [](Face& /*face*/) {}},
}};

}  // namespace

const Effect wrinkles_effect = {
    .name = "wrinkles",
    .what = "skin folds where the pose presses it together",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
