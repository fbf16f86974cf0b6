#pragma once
/// Where everything of a frame stands, before anything is drawn.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Everything of a character that no view changes: its pose and where it stands.
void place_character(CharacterState& character);

/// Starts a view of the frame: finds all that predicates look at.
void begin_view(FrameState& frame, SceneState& scene, const ViewFrame& view);

}  // namespace blush
