#pragma once
/// Sampling of keyed curves as glTF 2.0 defines them (appendix C: STEP, LINEAR with slerp for rotations, CUBICSPLINE).

#include <span>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// Writes the `track.width` values at `time_seconds` to `out` (at least that long). Before the first key and after the
/// last the nearest key holds. No allocation. A NaN time counts as the first key.
void sample(const Track& track, float time_seconds, std::span<float> out);

/// The same for a rotation track (width 4: x, y, z, w); slerp along the shorter arc, unit length out.
Quat sample_rotation(const Track& track, float time_seconds);

}  // namespace blush
