#pragma once
/// View: what a frame is drawn for.

#include <cstdint>

#include "rig/vectors.h"
#include "runtime/lighting.h"

namespace blush {

struct Camera {
    Mat4 view_from_world{1};
    Mat4 clip_from_view{1};

    bool operator==(const Camera&) const = default;
};

enum class Output : std::uint8_t {
    display_srgb,  ///< filmic curve and sRGB, for an 8-bit framebuffer
    linear_hdr,    ///< scene radiance, linear with sRGB's primaries, for a floating-point framebuffer
};

struct View {
    Camera camera;
    std::uint32_t width = 0, height = 0;  ///< pixels, of the framebuffer
    std::uint32_t framebuffer = 0;        ///< GL name; 0: the default framebuffer
    Output output = Output::display_srgb;
    float exposure = 1;                  ///< factor on radiance before the filmic curve
    const Lighting* lighting = nullptr;  ///< alive while drawing; null: three lights of a portrait, fixed to the camera
    /// Of multisampling, where the setting antialiasing.mode leaves it to the view; clamped to what the device has.
    std::uint32_t samples = 4;
    /// Nothing of the frame before may show: the first frame after a cut, a seek or a jump of the camera. (A view of
    /// another size is a cut by itself.)
    bool cut = false;
    /// The moment that the frame shows, from wherever the host counts: lights go round by it, and an automatic
    /// exposure adapts by the time since the frame before (at once after a cut, and where it is not later).
    double time_seconds = 0;
    std::uint32_t frame_number = 0;  ///< chooses the grain of the film
    Vec4 background_linear{0.035F, 0.037F, 0.042F, 1};
    bool timed = false;          ///< measure each pass (FrameReport::passes)
    bool check_finite = false;   ///< scan what each pass wrote (slow: reads it back)
    bool force_effects = false;  ///< run effects that could be left out, to show that leaving them out was right
};

}  // namespace blush
