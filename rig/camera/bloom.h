#pragma once
/// Bloom in double precision: the twin of shaders/bloom_*.frag.

#include "rig/map.h"
#include "rig/vectors.h"

namespace blush {

/// A pyramid of halved images: level 1 has half the sides (rounded up), level n the 2^n-th part. Its mean over the
/// levels, each enlarged by steps of two with the weights 3/4 and 1/4 (Chaikin 1974: quadratic B-splines in the limit),
/// is the light that has spread.
std::uint32_t bloom_levels(double radius_of_height, std::uint32_t width, std::uint32_t height);

/// Takes the share `strength` of what is brighter than `threshold` (by its largest channel) away from each pixel and
/// spreads it. All light stays, but for what borders and odd sides do to it; a constant image keeps every value.
/// Radiance that is not a number counts as 0, and 60000 is the most.
Map<DVec3> bloomed(const Map<DVec3>& radiance_linear, double strength, double threshold, std::uint32_t levels);

}  // namespace blush
