#pragma once
/// When a vector has a direction, for every path that normalises. No include: the SIMD kernels read it too
/// (rig/deform/simd/kernel_body.h says why they include next to nothing).

namespace blush {

/// Below this squared length a direction is rounding noise in single precision, and its reciprocal root may overflow.
inline constexpr float smallest_length2 = 1e-30F;
/// Above this one the length itself is about to overflow (the largest float is 3.4e38).
inline constexpr float largest_length2 = 1e37F;

}  // namespace blush
