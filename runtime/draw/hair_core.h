#pragma once
/// The opaque core of cards of hair: where they are dense they have depth and cast shadows, though they blend.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Cards of hair, brows and lashes: materials named so that blend or are cut out.
bool is_hair_card(const CharacterState& character, const Primitive& primitive);

/// Of a card: whether a texture says where it is dense.
bool is_textured_hair(const CharacterState& character, const Primitive& primitive);

enum class SeenFrom : std::uint8_t { camera, light };

/// Makes the programs of bind_hair_core() where they are not there yet.
void require_hair_cores(FrameState& frame, SeenFrom from);

/// Uses the program that leaves only the core of a primitive for which is_hair_card(), and binds its material. Nothing
/// but depth may be written. Seen from a light, uniform 0 is the matrix of shadow.vert.
void bind_hair_core(FrameState& frame, CharacterState& character, const Primitive& primitive, SeenFrom from);

}  // namespace blush
