#pragma once
/// The environment of a frame on the GPU.

#include "runtime/frame/character_state.h"

namespace blush {

/// Fills the block's coefficients of light from all around: the environment's, else those of sky and ground.
void write_ambient(const CharacterState& state, shared::FrameBlock& block);

/// Binds the filtered map, made when the environment is another one than last time.
void bind_environment(CharacterState& state);

}  // namespace blush
