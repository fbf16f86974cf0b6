#pragma once
/// How a host's projection and depth are meant, where not as GL's own.

namespace blush {

struct DepthConvention {
    bool zero_to_one = false;  ///< clip z from 0 to w (glClipControl); else from -w to w
    bool reversed = false;     ///< the near plane has depth 1, the far plane 0

    bool operator==(const DepthConvention&) const = default;
};

}  // namespace blush
