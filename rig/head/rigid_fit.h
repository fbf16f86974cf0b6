#pragma once
/// The rigid motion that a cloud of points went through, as nearly as one can say.

#include <span>

#include "rig/vectors.h"

namespace blush {

/// Turn and move, without scale or mirror, that takes `from` to `to` with the least sum of weight times squared
/// distance (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions"). All spans of one
/// length; weights 0 or more. Points in one line leave the turn about it open; without any weight: the identity.
DMat4 fit_rigid(std::span<const DVec3> from, std::span<const DVec3> to, std::span<const double> weights);

}  // namespace blush
