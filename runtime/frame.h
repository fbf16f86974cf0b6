#pragma once
/// The one place where a frame is declared and run.

#include "runtime/character_state.h"

namespace blush {

/// Evaluates the rig and brings the facts that predicates look at up to date.
void begin_frame(CharacterState& state, const View& view);

/// Declares the passes that turn the pose into the surface that is drawn; each effect adds its own or says why not.
void declare_effects(CharacterState& state);

/// Draws a frame; state.report says what was done.
void draw_frame(CharacterState& state, const View& view);

/// Runs the effects alone and leaves the deformed surface in its buffers.
void deform_only(CharacterState& state);

/// Passes that every frame has, in passes/.
void declare_shade(CharacterState& state);
void declare_resolve(CharacterState& state);
void declare_tone(CharacterState& state);
void declare_copy(CharacterState& state);

}  // namespace blush
