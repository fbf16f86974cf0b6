#pragma once
/// The vectors, matrices and rotations of public headers: the same types in every build, whatever a host asks of GLM.
/// glm::vec3 is another type where GLM_FORCE_DEFAULT_ALIGNED_GENTYPES is defined; these name their qualifier.

#include <cstdint>

#include <glm/glm.hpp>

// Members of another size, or structs that functions hand over in other registers: such a host would link, then crash.
#if GLM_CONFIG_LENGTH_TYPE != GLM_LENGTH_INT || GLM_CONFIG_DEFAULTED_FUNCTIONS == GLM_DISABLE || \
    GLM_CONFIG_SWIZZLE == GLM_SWIZZLE_OPERATOR
#error \
    "blush cannot be used with GLM_FORCE_SIZE_T_LENGTH, with GLM_FORCE_CTOR_INIT, or with GLM_FORCE_SWIZZLE and SIMD."
#endif

namespace blush {

using Vec2 = glm::vec<2, float, glm::packed_highp>;
using Vec3 = glm::vec<3, float, glm::packed_highp>;
using Vec4 = glm::vec<4, float, glm::packed_highp>;
using DVec2 = glm::vec<2, double, glm::packed_highp>;
using DVec3 = glm::vec<3, double, glm::packed_highp>;
using DVec4 = glm::vec<4, double, glm::packed_highp>;
using IVec2 = glm::vec<2, int, glm::packed_highp>;
using IVec4 = glm::vec<4, int, glm::packed_highp>;
using UVec3 = glm::vec<3, unsigned, glm::packed_highp>;
using U8Vec2 = glm::vec<2, std::uint8_t, glm::packed_highp>;
using U8Vec4 = glm::vec<4, std::uint8_t, glm::packed_highp>;
using U16Vec4 = glm::vec<4, std::uint16_t, glm::packed_highp>;
using Mat3 = glm::mat<3, 3, float, glm::packed_highp>;
using Mat4 = glm::mat<4, 4, float, glm::packed_highp>;
using DMat3 = glm::mat<3, 3, double, glm::packed_highp>;
using DMat4 = glm::mat<4, 4, double, glm::packed_highp>;

/// A rotation, of unit length. Not GLM's: GLM_FORCE_QUAT_DATA_WXYZ changes the order of members there.
struct Quat {
    float w = 1, x = 0, y = 0, z = 0;
    bool operator==(const Quat&) const = default;
};

}  // namespace blush
