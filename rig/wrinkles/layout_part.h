#pragma once
/// A part of a face's texture layout, for small maps that need not show all of it.

#include "rig/vectors.h"

namespace blush {

/// A rectangle of texture coordinates (v down), 0 to 1, from below to.
struct LayoutPart {
    Vec2 from{0}, to{1};

    bool is_whole() const { return from == Vec2(0) && to == Vec2(1); }
    /// Texture coordinates in a map that shows this part alone.
    template <class Uv>
    Uv within(Uv uv) const {
        return (uv - Uv(from)) / Uv(to - from);
    }
    bool operator==(const LayoutPart&) const = default;
};

}  // namespace blush
