#include "runtime/light/scatter_projection.h"

#include <cmath>

#include "runtime/frame/frame_state.h"

namespace blush {

ScatterProjection scatter_projection(const FrameState& frame, double millimetres_a_unit) {
    const glm::mat4& clip = frame.clip_from_view;
    ScatterProjection projection;
    projection.perspective = clip[2][3] != 0 ? 1 : 0;
    const double unit = projection.perspective != 0 ? 1 : 1 / millimetres_a_unit;
    const auto pixels = [unit](float scale, std::uint32_t side) {
        const double value = std::abs(static_cast<double>(scale)) * 0.5 * side * unit;
        return std::isfinite(value) ? value : 0;
    };
    projection.scale = {pixels(clip[0][0], frame.view->width), pixels(clip[1][1], frame.view->height)};
    return projection;
}

}  // namespace blush
