#include "runtime/draw/draw_casters.h"

#include <optional>

#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"

namespace blush {
namespace {

bool is_double_sided(const Face& face, const Primitive& primitive) {
    return primitive.material >= 0 && face.materials[static_cast<std::size_t>(primitive.material)].double_sided;
}

/// What is solid casts shadows; of cards only hair's opaque core does, or they would cast their whole outline.
bool is_solid(const Face& face, const Primitive& primitive) {
    return primitive.material < 0 ||
           face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::opaque;
}

std::optional<Casters> casters_of(const CharacterState& character, const Primitive& primitive) {
    if (is_hair_card(character, primitive))
        return is_textured_hair(character, primitive) ? Casters::textured_hair : Casters::hair;
    if (is_solid(character.face, primitive)) return Casters::solid;
    return std::nullopt;
}

}  // namespace

void draw_casters(FrameState& frame, CharacterState& character, Casters casters, const gl::Program& program,
                  const glm::dmat4& shadow_from_world) {
    character.model->bind_surface(*character.surface);
    each_drawn_primitive(character, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
        if (casters_of(character, primitive) != casters) return;
        if (casters != Casters::solid) {
            bind_hair_core(frame, character, primitive, SeenFrom::light);
        } else {
            use_program(frame, program);
        }
        const glm::mat4 shadow_from_mesh(shadow_from_world * character.stance.world_from_node[draw_index]);
        glUniformMatrix4fv(0, 1, GL_FALSE, &shadow_from_mesh[0][0]);
        // Only what light can meet from outside: through the open back of a shell it would come in at once, and shine
        // through the front as if that were thin.
        if (is_double_sided(character.face, primitive)) {
            glDisable(GL_CULL_FACE);
        } else {
            glEnable(GL_CULL_FACE);
        }
        glFrontFace(mirrored ? GL_CW : GL_CCW);
        draw_elements(frame, character, primitive);
    });
}

}  // namespace blush
