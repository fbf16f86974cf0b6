#pragma once
/// How large a millimetre of skin is on a view's screen.

#include "rig/light/scatter_image.h"

namespace blush {

struct FrameState;

ScatterProjection scatter_projection(const FrameState& frame, double millimetres_a_unit);

}  // namespace blush
