#pragma once
/// How far the parts of a face reach, whatever their materials.

#include <cstddef>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/face.h"

namespace blush {

struct Extents {
    struct Part {
        std::size_t node = 0;
        Bounds bounds;  ///< in its mesh, at rest
    };
    std::vector<Part> parts;
    std::vector<float> target_reach;  ///< of each target: its longest move at weight 1, mesh units
};

Extents find_extents(const Face& face);

}  // namespace blush
