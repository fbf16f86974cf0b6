#pragma once
/// The C++ side of shaders/shared.glsl.

#include <glm/glm.hpp>

namespace blush::shared {

using glm::ivec4;
using glm::mat4;
using glm::vec4;
#define BLUSH_UNIFORM_BLOCK(Name, Binding) struct Name
#include "shaders/shared.glsl"
#undef BLUSH_UNIFORM_BLOCK

}  // namespace blush::shared
