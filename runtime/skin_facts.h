#pragma once
/// Where a character's skin may be on the screen, and how large.

#include "runtime/character_state.h"

namespace blush {

/// Fills what never changes: which materials are skin, where the skin stands at rest.
void find_skin_parts(CharacterState& state);

/// Fills the skin's facts of this frame. Conservative: skin_on_screen is false only where no skin can be seen.
void find_skin_facts(CharacterState& state);

}  // namespace blush
