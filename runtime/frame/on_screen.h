#pragma once
/// Whether anything of a character can be on the screen: what cannot is not drawn, and needs no antialiasing.

#include <string_view>

#include "runtime/frame/frame_state.h"

namespace blush {

/// Conservative, with a pixel's margin for samples beside the pixel's middle: false only where every sample shows what
/// is behind it. Needs this view's places and active targets.
bool may_be_on_screen(const FrameState& frame, const CharacterState& character);

/// Why a frame needs one sample a pixel whatever is asked for: SceneFacts::has_triangles or on_screen is false.
std::string_view nothing_to_draw(const SceneFacts& facts);

/// The bounds of a character's face where its joints stand, in the face's space: at rest where it has none.
Bounds moved_bounds(const CharacterState& character);

}  // namespace blush
