#pragma once
/// How different two colours look: CIELAB and CIEDE2000, and sRGB's transfer function.

#include "rig/vectors.h"

namespace blush {

/// sRGB's transfer function (IEC 61966-2-1), extended to negative numbers as an odd function.
double srgb_from_linear(double linear);
double linear_from_srgb(double encoded);

/// CIE 1976 L*a*b* of a linear sRGB colour under sRGB's own white (D65): L* is 100 for (1, 1, 1). Any finite input.
DVec3 lab_from_srgb_linear(const DVec3& rgb_linear);

/// CIEDE2000 between two L*a*b* colours with parametric factors of 1. 1 is about what is just noticed.
/// Source: G. Sharma, W. Wu, E. Dalal, "The CIEDE2000 Color-Difference Formula: Implementation Notes, Supplementary
/// Test Data, and Mathematical Observations", Color Research and Application 30(1), 2005.
double ciede2000(const DVec3& lab_a, const DVec3& lab_b);

/// The same between two linear sRGB colours.
double ciede2000_of_srgb_linear(const DVec3& a_linear, const DVec3& b_linear);

}  // namespace blush
