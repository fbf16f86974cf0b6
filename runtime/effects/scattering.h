#pragma once
/// What the scattering effect, its studies and the frame share.

#include <span>
#include <vector>

#include "rig/light/separable_kernel.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/scatter_passes.h"

namespace blush {

/// Textures that a study wants the frame's input of the scattering copied to; 0: none.
struct ScatterCapture {
    GLuint light = 0, albedo = 0, depth = 0;
};

/// The profile of the material that the settings name.
std::span<const GaussianTerm> scatter_profile(const CharacterState& character);
/// The kernel that the settings ask for.
KernelShape scatter_kernel_shape(const CharacterState& character);
/// Step of depth that light does not cross; 0: it crosses all.
double scatter_follow_mm(const FrameState& frame, const CharacterState& character);

}  // namespace blush
