#pragma once
/// What of the registry a frame calls for: FrameState::on() and CharacterState::on() are known from here on.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Asks every effect, and reports the answers.
void find_needs(FrameState& frame);

/// What shades each character (CharacterState::shading); leaves out what finds no texture unit.
void find_shading(FrameState& frame);

}  // namespace blush
