#pragma once
/// The environment of a frame on the GPU.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Fills the block's coefficients of light from all around: the environment's, else those of sky and ground.
void write_ambient(const FrameState& frame, shared::FrameBlock& block);

/// Binds the filtered map, made when the environment is another one than last time.
void bind_environment(FrameState& frame);

}  // namespace blush
