/// Wrinkles: normals that fold where the pose presses the skin together (jimenez-2012, chapter 8).

#include <algorithm>
#include <array>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush::shared {
#include "shaders/wrinkles/wrinkles_uniforms.glsl"
}  // namespace blush::shared

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
using Own = OwnSetting<wrinkles_effect, settings>;

bool any_wrinkle(const CharacterState& character) {
    return std::ranges::any_of(character.pose.wrinkles, [](float weight) { return weight != 0; });
}

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.asset.appearance().wrinkles) {
        return {.on = false,
                .reason = "the face has no wrinkle maps (blush bake wrinkles makes them)",
                .can_be_forced = false};
    }
    if (character.settings.choice(Own("shown")) == 1) {
        return {.on = false, .reason = "wrinkles.shown says no", .can_be_forced = false};
    }
    if (!any_wrinkle(character)) return {.on = false, .reason = "no zone of the face is pressed together or smoothed"};
    if (character.skin.pixels_a_mm < character.settings.number(Own("least_pixels_a_mm"))) {
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

bool of_differences(const CharacterState& character) { return character.settings.choice(Own("encoding")) == 1; }

std::uint32_t variant(const FrameState& /*frame*/, const CharacterState& character) {
    return of_differences(character) ? 1 : 0;
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::WrinklesUniforms*>(to);
    const WrinkleSet& set = *character.asset.appearance().wrinkles;
    std::array<float, std::size_t{4} * BLUSH_MOST_WRINKLE_MASKS> weights{};
    zone_weights_of(character, weights);
    for (std::size_t z = 0; z < weights.size(); ++z) out.weights[z / 4][static_cast<glm::length_t>(z % 4)] = weights[z];
    const glm::vec2 scale = 1.0F / (set.part.to - set.part.from);
    out.part = glm::vec4(scale, -set.part.from * scale);
    out.range = set.range;
}

void bind(FrameState& /*frame*/, CharacterState& character, std::uint32_t unit) {
    const WrinkleTextures& textures = wrinkle_textures(character);
    glBindTextureUnit(unit, (of_differences(character) ? textures.differences : textures.derivatives).name());
    glBindTextureUnit(unit + 1, textures.masks.name());
}

constexpr std::array<std::string_view, 1> hooks = {"relief"};
constexpr std::array<ShadingVariant, 1> variants = {{{"WRINKLE_DIFFERENCES"}}};
constexpr std::array<UniformField, 3> fields = {{{"weights[0]", offsetof(shared::WrinklesUniforms, weights)},
                                                 {"part", offsetof(shared::WrinklesUniforms, part)},
                                                 {"range", offsetof(shared::WrinklesUniforms, range)}}};
constexpr ShadingPart shading = {
    .file = "wrinkles/wrinkles.glsl",
    .hooks = hooks,
    .materials = materials_of(MaterialKind::skin),
    .variants = variants,
    .variant = variant,
    .uniforms = {"wrinkles/wrinkles_uniforms.glsl", "WrinklesUniforms", sizeof(shared::WrinklesUniforms), fields,
                 write},
    .textures = 2,
    .bind = bind,
};

}  // namespace

constinit const SettingId wrinkles_encoding = Own("encoding");
constinit const SettingId wrinkles_storage = Own("storage");

const Effect wrinkles_effect = {
    .name = "wrinkles",
    .what = "skin folds where the pose presses it together",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .declare = declare,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
