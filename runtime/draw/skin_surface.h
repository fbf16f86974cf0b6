#pragma once
/// Where a face's skin is, and how it stands in the view being drawn: what the effects on skin ask.

#include <cstddef>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/face.h"

namespace blush {

struct CharacterState;
struct FrameState;

struct SkinSurface {
    /// A primitive that is skin, as a node draws it.
    struct Part {
        std::size_t node = 0;
        Bounds bounds;  ///< in its mesh, at rest
    };
    std::vector<bool> material;       ///< whether it is skin, of each material and, last, the default one
    std::vector<Part> parts;          ///< by node; none: the face has no skin
    std::vector<float> target_reach;  ///< of each target: its longest move of skin at weight 1, mesh units
};

SkinSurface find_skin(const Face& face);

/// How a character's skin stands in the view being drawn.
struct SkinOnScreen {
    bool on_screen = false;  ///< it may be seen; false only where it cannot be
    double pixels_a_mm = 0;  ///< on the screen, at the nearest place where skin may be
};

SkinOnScreen place_skin(const FrameState& frame, const CharacterState& character);

}  // namespace blush
