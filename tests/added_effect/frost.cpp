/// An effect that the library does not know, in one file: what docs/adding_an_effect.md asks for and no more.

#include <epoxy/gl.h>

#include <array>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"
#include "runtime/gl/shared_blocks.h"
#include "tests/added_effect/frost.h"

namespace blush::shared {
struct FrostUniforms {
    float amount;
    float unused_0, unused_1, unused_2;
};
}  // namespace blush::shared

namespace blush {
namespace {

constexpr std::array<EmbeddedShader, 2> files = {{{"frost/frost_uniforms.glsl", R"(
struct FrostUniforms {
    float amount;
    float unused_0, unused_1, unused_2;
};
)"},
                                                  {"frost/frost.glsl", R"(
#ifdef BAD_FROST
this is not GLSL
#endif
layout(binding = FROST_UNIT) uniform sampler2D frost_map;
void frost_colour(Interpolants at, inout vec3 color) {
    color = mix(color, texture(frost_map, at.layout_uv.at).rgb, frost.amount);
}
)"}}};

constexpr std::array<std::string_view, 2> good_or_bad = {"good", "bad"};
constexpr std::array<Setting, 2> settings = {
    {{.name = "amount", .meaning = "how white the skin is", .highest = 1, .default_number = 0},
     {"text", "good: its shader compiles; bad: it does not", good_or_bad}}};

float amount(const CharacterState& character) {
    return static_cast<float>(character.settings.number("frost", "amount"));
}

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (amount(character) == 0) return {.on = false, .reason = "frost.amount is 0"};
    return {.on = true, .reason = "it is cold"};
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    static_cast<shared::FrostUniforms*>(to)->amount = amount(character);
}

struct FrostMap {
    gl::Texture texture;
};

void bind(FrameState& frame, CharacterState& /*character*/, std::uint32_t unit) {
    gl::Texture& map = frame.shared_own<FrostMap>().texture;
    if (!map) {
        map = gl::make_texture(GL_TEXTURE_2D);
        constexpr std::array<std::uint8_t, 4> ice = {200, 225, 255, 255};
        glTextureStorage2D(map.name(), 1, GL_RGBA8, 1, 1);
        glTextureSubImage2D(map.name(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, ice.data());
    }
    glBindTextureUnit(unit, map.name());
}

std::uint32_t variant(const FrameState& /*frame*/, const CharacterState& character) {
    return character.settings.choice("frost", "text");
}

constexpr std::array<std::string_view, 1> hooks = {"colour"};
constexpr std::array<ShadingVariant, 1> variants = {{{"BAD_FROST"}}};
constexpr std::array<UniformField, 1> fields = {{{"amount", offsetof(shared::FrostUniforms, amount)}}};
constexpr ShadingPart shading = {
    .file = "frost/frost.glsl",
    .own_files = files,
    .hooks = hooks,
    .materials = materials_of(MaterialKind::skin),
    .variants = variants,
    .variant = variant,
    .uniforms = {"frost/frost_uniforms.glsl", "FrostUniforms", sizeof(shared::FrostUniforms), fields, write},
    .textures = 1,
    .bind = bind,
};

}  // namespace

const Effect frost_effect = {
    .name = "frost",
    .what = "skin turns white in the cold",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .shading = &shading,
    .hard_cases = {},
};

}  // namespace blush
