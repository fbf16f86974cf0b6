#include "runtime/draw/hair_core.h"

#include <array>
#include <cassert>

namespace blush {
namespace {

struct HairCorePrograms {
    std::array<gl::Program, 4> made;  // bit 0: with a texture, bit 1: seen from a light
};

}  // namespace

bool is_hair_card(const CharacterState& state, const Primitive& primitive) {
    if (primitive.material < 0) return false;
    const auto material = static_cast<std::size_t>(primitive.material);
    return state.material_kind[material] == MaterialKind::hair &&
           state.face.materials[material].alpha_mode != AlphaMode::opaque;
}

void bind_hair_core(CharacterState& state, const Primitive& primitive, SeenFrom from) {
    const Material& material = state.face.materials[static_cast<std::size_t>(primitive.material)];
    const bool textured = material.base_color_srgb.image >= 0;
    gl::Program& program =
        state.own<HairCorePrograms>().made[(textured ? 1U : 0U) + (from == SeenFrom::light ? 2U : 0U)];
    if (!program) {
        constexpr std::array<std::string_view, 1> with_texture = {"BASE_COLOR_MAP"};
        const std::span<const std::string_view> defines(with_texture.data(), textured ? 1 : 0);
        Result<gl::Program> made = gl::make_program(
            {from == SeenFrom::light ? "light/shadow.vert" : "draw/face.vert", "draw/hair_core.frag", defines});
        assert(made && "hair_core.frag does not compile");
        program = *std::move(made);
    }
    glUseProgram(program.name());
    state.model.bind_maps(state.face, primitive.material);
}

}  // namespace blush
