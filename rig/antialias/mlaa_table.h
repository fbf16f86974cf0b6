#pragma once
/// MLAA's area table (jimenez-2012, 9.4.3; figure 9.2, right).

#include "rig/antialias/smaa_tables.h"

namespace blush {

/// Distances 0 to 8.
inline constexpr int mlaa_distances = 9;

/// 45 x 45, two channels: x = 9 * left crossing + left, y = 9 * right crossing + right (listing 9.4); the row and the
/// column of blocks of code 2 are empty. Computed on the first call.
const AreaImage& mlaa_areas();

}  // namespace blush
