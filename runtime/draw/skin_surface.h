#pragma once
/// Where a character's skin is, and how it stands in the frame being drawn: what the effects on skin ask.

#include <cstddef>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/face.h"

namespace blush {

struct CharacterState;

struct SkinSurface {
    /// A primitive that is skin, as a node draws it.
    struct Part {
        std::size_t node = 0;
        Bounds bounds;  ///< in its mesh, at rest
    };
    std::vector<bool> material;       ///< whether it is skin, of each material and, last, the default one
    std::vector<Part> parts;          ///< by node; none: the face has no skin
    std::vector<float> target_reach;  ///< of each target: its longest move of skin at weight 1, mesh units

    // Of the frame.
    bool on_screen = false;  ///< it may be seen; false only where it cannot be
    double pixels_a_mm = 0;  ///< on the screen, at the nearest place where skin may be
};

/// What never changes.
SkinSurface find_skin(const Face& face);

/// The scale of the face that the settings want, and where that frame's skin is on the screen.
void place_skin(CharacterState& state);

}  // namespace blush
