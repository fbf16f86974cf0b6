#pragma once
/// The occlusion coefficients of a face on the GPU.

#include "runtime/frame/frame_state.h"

namespace blush {

/// Binds the coefficients, uploaded when first asked for.
void bind_occlusion(CharacterState& character);

/// The buffer's contents: three entries a vertex and pose, as shaders/light/occlusion.glsl reads them.
std::vector<glm::vec4> packed_occlusion(const OcclusionSet& set);

struct OcclusionBuffer {
    gl::Buffer coefficients;
};

}  // namespace blush
