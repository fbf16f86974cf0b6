#include "runtime/antialias/sampling.h"

#include <algorithm>
#include <cassert>

#include "runtime/effects/shared_settings.h"

namespace blush {
namespace {

bool velocities_wanted(const EffectSettings& settings) { return settings.choice(velocities_source) == 0; }

}  // namespace

glm::vec2 Sampling::sample_offset_pixels(std::uint32_t picture, std::uint32_t phase) const {
    assert(picture < pictures && phase < 2);
    // jimenez-2012, figure 10.11: two samples at (-0.25, 0.25) and (0.25, -0.25).
    const auto of_two = [](std::uint32_t which) {
        return which == 0 ? glm::vec2(-0.25F, 0.25F) : glm::vec2(0.25F, -0.25F);
    };
    switch (mode) {
        case AntialiasingMode::smaa_s2x:
            return of_two(picture);
        case AntialiasingMode::smaa_t2x:
            return temporal ? of_two(phase) : glm::vec2(0);
        case AntialiasingMode::smaa_4x: {
            if (!temporal) return of_two(picture);
            // The rotated grid of four, a pair of opposite places a frame. (Figure 10.11 moves the pair of S2x by an
            // eighth of a pixel along the other diagonal, which is what samples at fixed places of a multisampled
            // target allow: it crowds the four along one diagonal, and moves the picture from frame to frame where the
            // last frame has no share. Ours are drawn, so they may stand anywhere.)
            const glm::vec2 place = phase == 0 ? glm::vec2(-0.125F, -0.375F) : glm::vec2(-0.375F, 0.125F);
            return picture == 0 ? place : -place;
        }
        case AntialiasingMode::supersampled: {
            std::uint32_t side = 1;
            while (side * side < pictures) ++side;
            const glm::vec2 cell(static_cast<float>(picture % side), static_cast<float>(picture / side));
            return (cell + 0.5F) / static_cast<float>(side) - 0.5F;
        }
        default:
            return glm::vec2(0);
    }
}

Sampling find_sampling(const EffectSettings& settings, const ViewFrame& view, std::uint32_t largest_sample_count,
                       bool on_screen) {
    Sampling sampling;
    sampling.mode = static_cast<AntialiasingMode>(settings.choice(antialiasing_mode));
    if (!on_screen) return {};
    const auto multisampled = [&](std::uint32_t wanted) {
        return std::clamp(wanted, 1U, std::max(1U, largest_sample_count));
    };
    switch (sampling.mode) {
        case AntialiasingMode::view:
            sampling.samples = multisampled(view.samples);
            break;
        case AntialiasingMode::none:
            break;
        case AntialiasingMode::msaa2:
            sampling.samples = multisampled(2);
            break;
        case AntialiasingMode::msaa4:
            sampling.samples = multisampled(4);
            break;
        case AntialiasingMode::mlaa:
        case AntialiasingMode::smaa_1x:
            sampling.filtered = true;
            break;
        case AntialiasingMode::smaa_s2x:
            sampling.filtered = true;
            sampling.pictures = 2;
            break;
        case AntialiasingMode::smaa_t2x:
            sampling.filtered = true;
            sampling.temporal = velocities_wanted(settings);
            break;
        case AntialiasingMode::smaa_4x:
            sampling.filtered = true;
            sampling.pictures = 2;
            sampling.temporal = velocities_wanted(settings);
            break;
        case AntialiasingMode::supersampled: {
            const auto side = static_cast<std::uint32_t>(settings.number(supersampling_factor));
            sampling.pictures = side * side;
            break;
        }
    }
    return sampling;
}

Camera jittered(const Camera& camera, glm::vec2 sample_offset_pixels, std::uint32_t width, std::uint32_t height) {
    if (sample_offset_pixels == glm::vec2(0)) return camera;
    // The picture moves against the samples. In clip space a pixel is 2 / size wide once divided by w.
    const glm::vec2 move = -2.0F * sample_offset_pixels / glm::vec2(width, height);
    Camera moved = camera;
    for (glm::length_t column = 0; column < 4; ++column) {
        moved.clip_from_view[column].x += move.x * camera.clip_from_view[column].w;
        moved.clip_from_view[column].y += move.y * camera.clip_from_view[column].w;
    }
    return moved;
}

}  // namespace blush
