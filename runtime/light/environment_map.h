#pragma once
/// The environment of a frame on the GPU.

#include <array>

#include "runtime/frame/frame_state.h"

namespace blush {

/// shared::FrameBlock::ambient_sh: of the environment, else of sky and ground.
std::array<glm::vec4, 9> ambient_sh(const Lighting& lighting);
/// Share that white reflects of each coefficient of radiance: the cosine's convolution over pi, 1, 2 / 3 and 1 / 4 by
/// band.
inline constexpr std::array<double, 9> white_share_of_band = {1,    2.0 / 3, 2.0 / 3, 2.0 / 3, 0.25,
                                                              0.25, 0.25,    0.25,    0.25};

/// How a frame sees its environment map; what is not finite, or beyond all measure, is brought back.
struct EnvironmentView {
    float factor = 1, turn_radians = 0;
};
EnvironmentView environment_view(const Lighting& lighting);

/// Binds the filtered map, made when the environment is another one than last time.
void bind_environment(FrameState& frame, std::uint32_t unit);

}  // namespace blush
