#pragma once
/// What others than a frame ask about normals.

#include "runtime/frame/character_state.h"

namespace blush {

/// Where the character's settings have its normals come from.
NormalMethod normal_method_of(const CharacterState& character);

}  // namespace blush
