#include "runtime/draw/hair_core.h"

#include <array>

#include "runtime/draw/draw_face.h"

namespace blush {
namespace {

struct HairCorePrograms {
    std::array<gl::Program, 4> made;  // bit 0: with a texture, bit 1: seen from a light
};

std::size_t index_of(bool textured, SeenFrom from) {
    return (textured ? 1U : 0U) + (from == SeenFrom::light ? 2U : 0U);
}

}  // namespace

bool is_hair_card(const CharacterState& character, const Primitive& primitive) {
    if (primitive.material < 0) return false;
    const auto material = static_cast<std::size_t>(primitive.material);
    return character.facts_of_face.material_kind[material] == MaterialKind::hair &&
           character.face.materials[material].alpha_mode != AlphaMode::opaque;
}

bool is_textured_hair(const CharacterState& character, const Primitive& primitive) {
    return character.face.materials[static_cast<std::size_t>(primitive.material)].base_color_srgb.image >= 0;
}

void require_hair_cores(FrameState& frame, SeenFrom from) {
    constexpr std::array<std::string_view, 1> with_texture = {"BASE_COLOR_MAP 0"};
    for (const bool textured : {false, true}) {
        const std::span<const std::string_view> defines(with_texture.data(), textured ? 1 : 0);
        gl::require_program(
            frame.shared_own<HairCorePrograms>().made[index_of(textured, from)],
            {from == SeenFrom::light ? "light/shadow.vert" : "draw/face.vert", "draw/hair_core.frag", defines});
    }
}

void bind_hair_core(FrameState& frame, CharacterState& character, const Primitive& primitive, SeenFrom from) {
    const bool textured = is_textured_hair(character, primitive);
    use_program(frame, frame.shared_own<HairCorePrograms>().made[index_of(textured, from)]);
    character.model->bind_maps(primitive.material, textured ? base_color_texture : 0);
}

}  // namespace blush
