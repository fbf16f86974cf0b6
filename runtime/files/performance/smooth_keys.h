#pragma once
/// Keys whose stretches ease in different ways, as one cubic spline.

#include <span>

#include "rig/face.h"
#include "rig/motion/ease.h"

namespace blush {

/// A cubic_spline track of width 1 through linear keys of width 1, which never passes beyond two neighbouring keys and
/// is level at the first, the last and every turning point.
///
/// Source: Fritsch and Butland, "A method for constructing local monotone piecewise cubic interpolants", SIAM J. Sci.
/// Stat. Comput. 5(2), 1984, in the weighted form for uneven steps (Brodlie). Level ends are ours: outside its keys a
/// track holds, so only a level end joins that without a kink.
Track smooth_track(const Track& linear);

/// The same keys; `eases[i]` says how the curve goes from key i to the next (the last one counts for nothing).
Track eased_track(const Track& linear, std::span<const Ease> eases);

}  // namespace blush
