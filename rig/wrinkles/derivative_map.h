#pragma once
/// Normal maps as partial derivatives (jimenez-2012, 8.2, after Acton 2008), and the differences of normals that are
/// the alternative (8.2.1).
///
/// Sign as printed in 8.2: n' = (n_x / n_z, n_y / n_z) and back n = normalize(n'_x, n'_y, 1); neither has a minus. So a
/// derivative map is minus the slope of the height that it came from, and adding maps is adding heights.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/map.h"
#include "rig/vectors.h"

namespace blush {

/// Maps in tangent space: x along the tangent, y along the bitangent.
using NormalMap = Map<Vec3>;      ///< unit vectors
using DerivativeMap = Map<Vec2>;  ///< n_x / n_z, n_y / n_z

/// How far from flat a stored derivative can be: 1 is the 45 degrees that 8 bits of the paper reach (8.2.1), 4 is 76
/// degrees at a quarter of the precision.
inline constexpr float published_derivative_range = 1;

/// n: any vector; where it does not point out of the surface (n_z <= 0) or is not finite, the derivative is the
/// steepest one of the range in n's direction, or flat. Each component is held to [-range, range], as storage does.
Vec2 derivative_from_normal(Vec3 n, float range);
/// Unit length. (0, 0) gives (0, 0, 1) to the bit.
Vec3 normal_from_derivative(Vec2 derivative);

/// Share of the texels that the range cut off goes to `*saturated` where that is given.
DerivativeMap derivatives_from_normals(const NormalMap& normals, float range, double* saturated = nullptr);

/// Slopes of a height field by central differences (one-sided at the border): height and texel size in one unit. With
/// the sign above: uphill along x gives a negative x.
DerivativeMap derivatives_from_heights(std::span<const float> heights, std::uint32_t width, std::uint32_t height,
                                       Vec2 texel_size);

/// A component as 8 signed bits hold it (GL's SNORM, where 0 is exact): -127 to 127 for -range to range.
std::int8_t stored_derivative(float derivative, float range);
float derivative_from_stored(std::int8_t stored, float range);

/// d = w - b per component, held to [-1, 1], as 8 bits hold the printed 0.5 + 0.5 d.
Vec3 normal_difference(Vec3 wrinkled, Vec3 base);
/// The base with a weighted difference on it, normalised; the base where the sum has no direction.
Vec3 add_normal_difference(Vec3 base, Vec3 difference, float weight);

}  // namespace blush
