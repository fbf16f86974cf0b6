#pragma once
/// What shading needs of the parts that are no skin.

#include <cstdint>

#include "runtime/frame/character_state.h"

namespace blush {

/// ShadeBits of the kinds of parts that are shaded in their own way.
std::uint32_t parts_bits(const CharacterState& character);
/// Where the eyes, their lids and the mouth are in this frame.
void write_parts(CharacterState& character, shared::FrameBlock& block);

}  // namespace blush
