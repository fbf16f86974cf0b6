#pragma once
/// Second pass: how much of its neighbour each side of an edge takes (jimenez-2012, 9.4 and 10.4.2).
///
/// Written plainly, pixel by pixel; the GPU takes four edges in one bilinear fetch and must get the same numbers.

#include "rig/antialias/pixels.h"
#include "rig/antialias/settings.h"

namespace blush {

/// slices: {0, 0, 0, 0} for samples at the pixel centres.
WeightMap smaa_weights(const EdgeMap& edges, const SmaaSettings& settings, SubsampleSlices slices = SubsampleSlices(0));

WeightMap mlaa_weights(const EdgeMap& edges, const MlaaSettings& settings);

/// A staircase of fewer edges than this is left to the orthogonal patterns. Five is the shortest with a step of one
/// pixel both ways, which contours flatter than 1 in 2 do not have.
inline constexpr int fewest_diagonal_edges = 5;

}  // namespace blush
