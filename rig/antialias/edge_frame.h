#pragma once
/// Four ways to look at an edge, so that each pattern is written once.

#include "rig/antialias/pixels.h"

namespace blush {

/// A view of the edges around one of them, in which it is the upper edge of pixel (0, 0) and a staircase of interest
/// climbs towards the upper right.
class EdgeFrame {
public:
    /// The upper edge of (x, y), as it is.
    static EdgeFrame horizontal(const EdgeMap& edges, int x, int y) {
        return {edges, {x, y}, {1, 0}, {0, 1}, {0, 0}, false};
    }
    /// The same, with left and right exchanged.
    static EdgeFrame horizontal_mirrored(const EdgeMap& edges, int x, int y) {
        return {edges, {x, y}, {-1, 0}, {0, 1}, {1, 0}, false};
    }
    /// The left edge of (x, y), with x and y exchanged.
    static EdgeFrame vertical(const EdgeMap& edges, int x, int y) {
        return {edges, {x, y}, {0, 1}, {1, 0}, {0, 0}, true};
    }
    /// The same, of the picture with left and right exchanged: pixel (0, 0) stands left of the edge.
    static EdgeFrame vertical_mirrored(const EdgeMap& edges, int x, int y) {
        return {edges, {x, y}, {0, 1}, {-1, 0}, {-1, 0}, true};
    }

    /// Upper edge of pixel (i, j) of the view.
    bool upper(int i, int j) const { return edge(origin_ + i * along_i_ + j * along_j_, transposed_); }
    /// Left edge of pixel (i, j) of the view.
    bool left(int i, int j) const { return edge(origin_ + i * along_i_ + j * along_j_ + left_shift_, !transposed_); }

private:
    EdgeFrame(const EdgeMap& edges, IVec2 origin, IVec2 along_i, IVec2 along_j, IVec2 left_shift, bool transposed)
        : edges_(edges),
          origin_(origin),
          along_i_(along_i),
          along_j_(along_j),
          left_shift_(left_shift),
          transposed_(transposed) {}
    bool edge(IVec2 p, bool left) const { return left ? edges_.left(p.x, p.y) : edges_.upper(p.x, p.y); }

    const EdgeMap& edges_;
    IVec2 origin_, along_i_, along_j_, left_shift_;
    bool transposed_;
};

}  // namespace blush
