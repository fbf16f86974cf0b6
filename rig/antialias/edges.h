#pragma once
/// First pass: which boundaries between pixels are edges (jimenez-2012, 9.3 and 10.4.1).

#include "rig/antialias/pixels.h"
#include "rig/antialias/settings.h"

namespace blush {

/// depth: may be empty unless settings.source is depth or predication is on; else as large as `picture`. Values that
/// are not finite or negative count as 0, those above 65504 (the largest half float) as that.
EdgeMap find_edges(const Pixels& picture, const DepthPixels& depth, const EdgeSettings& settings,
                   const PictureMeaning& meaning);

}  // namespace blush
