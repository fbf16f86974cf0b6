#pragma once
/// Draws what of a character casts shadows, as a light sees it: depth alone.

#include <array>

#include "runtime/frame/frame_state.h"

namespace blush {

/// Drawn one after the other for all characters, so that programs are not switched for each of them.
enum class Casters : std::uint8_t { solid, hair, textured_hair };
inline constexpr std::array<Casters, 3> all_casters = {Casters::solid, Casters::hair, Casters::textured_hair};

/// With depth test and viewport as the caller set them. program: light/shadow.vert.
void draw_casters(FrameState& frame, CharacterState& character, Casters casters, const gl::Program& program,
                  const glm::dmat4& shadow_from_world);

}  // namespace blush
