#pragma once
/// How a frame is sampled: multisampling, pictures drawn from several places in the pixel, places that change from
/// frame to frame. Found once a frame, from the settings and the view; everything else asks here.

#include <array>
#include <cstdint>
#include <string_view>

#include <glm/glm.hpp>

#include "runtime/settings.h"
#include "runtime/view.h"

namespace blush {

/// In the order of antialiasing_modes.
enum class AntialiasingMode : std::uint8_t {
    view,          ///< multisampling with ViewFrame::samples
    none,          ///< one sample in the middle of the pixel
    msaa2,         ///< multisampling, two samples (more where the device has no two)
    msaa4,         ///< multisampling, four samples
    mlaa,          ///< jimenez-2012, chapter 9
    smaa_1x,       ///< jimenez-2012, chapter 10: the filter alone
    smaa_s2x,      ///< two pictures a frame
    smaa_t2x,      ///< one picture a frame, from one of two places in turn
    smaa_4x,       ///< two pictures a frame, from two of four places in turn
    supersampled,  ///< a grid of pictures: the reference
};
inline constexpr std::array<std::string_view, 10> antialiasing_modes = {
    "view", "none", "msaa2", "msaa4", "mlaa", "smaa_1x", "smaa_s2x", "smaa_t2x", "smaa_4x", "supersampled"};

struct Sampling {
    AntialiasingMode mode = AntialiasingMode::none;
    std::uint32_t samples = 1;   ///< of multisampling
    std::uint32_t pictures = 1;  ///< drawn one after the other and averaged
    bool filtered = false;       ///< each picture goes through MLAA or SMAA
    bool temporal = false;       ///< the places change from frame to frame, and the frame before is blended in

    bool operator==(const Sampling&) const = default;

    /// Where picture `picture` is sampled, in pixels from the pixel's middle, x right and y up, each within +-0.5.
    /// phase: 0 or 1, the frame's number modulo 2 in a temporal mode. The places of all pictures of both phases sum to
    /// zero, so that no mode moves the picture.
    glm::vec2 sample_offset_pixels(std::uint32_t picture, std::uint32_t phase) const;
};

/// on_screen: something may be drawn; where nothing is, one sample is exact in every mode.
Sampling find_sampling(const EffectSettings& settings, const ViewFrame& view, std::uint32_t largest_sample_count,
                       bool on_screen);

/// The camera whose pixel middles fall on `sample_offset_pixels` of `camera`'s pixels. The only way in which jitter
/// reaches a frame: what draws geometry uses FrameState::camera.
Camera jittered(const Camera& camera, glm::vec2 sample_offset_pixels, std::uint32_t width, std::uint32_t height);

}  // namespace blush
