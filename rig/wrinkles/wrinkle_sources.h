#pragma once
/// The poses that wrinkle a face, as its rig has them: what bake_wrinkles() starts from.

#include <vector>

#include "rig/controls/rig.h"
#include "rig/wrinkles/wrinkle_maps.h"

namespace blush {

/// One for each row of the description's wrinkle weights whose drivers move a target: the pose with those drivers at
/// full strength, and what the rig makes of them. `rig` is the rig of `description`.
std::vector<WrinkleSource> wrinkle_sources(const Rig& rig, const RigDescription& description);

}  // namespace blush
