#pragma once
/// Third pass: each pixel takes from its four neighbours what the weights say (jimenez-2012, 9.5).

#include "rig/antialias/pixels.h"
#include "rig/antialias/settings.h"

namespace blush {

/// Pixels without weights keep their bits, but NaN becomes 0 and infinities the largest half float (65504).
Pixels blend_neighbors(const Pixels& picture, const WeightMap& weights, const PictureMeaning& meaning);

/// All three passes on one picture.
Pixels smaa(const Pixels& picture, const DepthPixels& depth, const SmaaSettings& settings,
            const PictureMeaning& meaning);
Pixels mlaa(const Pixels& picture, const DepthPixels& depth, const MlaaSettings& settings,
            const PictureMeaning& meaning);

}  // namespace blush
