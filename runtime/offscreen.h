#pragma once
/// Offscreen: a framebuffer to draw into without a window, and the picture read back from it.

#include <cstdint>
#include <memory>

#include "rig/face.h"
#include "rig/result.h"
#include "runtime/device.h"
#include "runtime/view.h"

namespace blush {

class Offscreen {
public:
    /// 8-bit for display_srgb, half float for linear_hdr. Error: a side of 0 or beyond the device's limit.
    static Result<Offscreen> create(const Device& device, std::uint32_t width, std::uint32_t height, Output output);

    /// What a frame into this framebuffer is drawn for; the camera is still to be set.
    ViewFrame view() const;

    /// RGBA, rows from the top: bytes of display_srgb, floats of linear_hdr.
    Image read() const;

private:
    struct State;
    explicit Offscreen(std::shared_ptr<State> state);
    std::shared_ptr<State> state_;
};

}  // namespace blush
