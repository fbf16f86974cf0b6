#pragma once
// GLM's quaternions and the library's, for tests that turn nodes and check it by GLM's own functions.

#include <glm/gtc/quaternion.hpp>

#include "rig/vectors.h"

namespace blush {

inline Quat rotation_of(const glm::quat& q) { return {q.w, q.x, q.y, q.z}; }
inline glm::quat glm_of(const Quat& q) { return glm::quat(q.w, q.x, q.y, q.z); }

}  // namespace blush
