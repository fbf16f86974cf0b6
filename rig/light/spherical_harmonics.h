#pragma once
/// Nine spherical-harmonics coefficients of light and of transfer (chappuis-2011, 3.1 to 3.4; Ramamoorthi and Hanrahan
/// 2001). Real basis without the Condon-Shortley phase: coefficient i = l (l + 1) + m; band 1 is (y, z, x).

#include <array>
#include <cstdint>
#include <span>

#include "rig/vectors.h"

namespace blush {

using Sh9 = std::array<double, 9>;
using Sh9Color = std::array<DVec3, 9>;

/// The nine basis functions in a unit direction.
Sh9 sh_basis(DVec3 direction);

/// Coefficients of max(n . w, 0): what a surface with that normal gathers where nothing hides the light (3.3, V = 1).
/// Pi, 2 pi / 3 and pi / 4 times the basis at n (Ramamoorthi and Hanrahan 2001, eq. 8).
Sh9 clamped_cosine(DVec3 normal);

/// Eq. 3.5: the integral of light times transfer.
DVec3 dot(const Sh9Color& light, const Sh9& transfer);

/// The 9x9 matrix that turns coefficients with `rotation` (3.4): rotate(f)(w) = f(rotation^-1 w). Built from the basis
/// at nine directions instead of the Euler angles of 3.4, which have a singular pose; the test holds it to the printed
/// matrices.
std::array<Sh9, 9> sh_rotation(const DMat3& rotation);
Sh9 rotate(const std::array<Sh9, 9>& matrix, const Sh9& coefficients);
Sh9Color rotate(const std::array<Sh9, 9>& matrix, const Sh9Color& coefficients);

/// Coefficients of a radiance map in equal longitudes and latitudes (environment_direction()): rows from the top,
/// `channels` interleaved values a pixel (1: grey; a fourth is not looked at). What is not finite or below 0 counts
/// as 0.
Sh9Color project_environment(std::span<const float> pixels, std::uint32_t width, std::uint32_t height,
                             std::uint32_t channels);

/// Direction of a place of such a map; u to the right, v down, both 0 to 1. The middle of the map is +Z, where a glTF
/// face looks, so that its left edge lies behind the head; +X (the face's left) is at u = 3/4.
DVec3 environment_direction(double u, double v);

}  // namespace blush
