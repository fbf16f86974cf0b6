#pragma once
/// Whether anything of a character can be on the screen: what cannot needs no antialiasing, and no second picture.

#include "runtime/frame/character_state.h"

namespace blush {

/// Conservative, with a pixel's margin for samples beside the pixel's middle: false only where every sample shows the
/// background. Needs this frame's nodes and active targets.
bool may_be_on_screen(CharacterState& state, const View& view);

/// Why a frame needs one sample a pixel whatever is asked for: SceneFacts::has_triangles or on_screen is false.
std::string_view nothing_to_draw(const SceneFacts& facts);

}  // namespace blush
