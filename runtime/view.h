#pragma once
/// View: what belongs to a picture from frame to frame; ViewFrame: what one frame of it is drawn for.

#include <cstdint>
#include <memory>
#include <string_view>

#include "rig/result.h"
#include "rig/vectors.h"
#include "runtime/depth_convention.h"
#include "runtime/device.h"
#include "runtime/lighting.h"

namespace blush {

/// view_from_world is composed with everything's place in double precision, so that a frame looks the same wherever in
/// the world it stands.
struct Camera {
    DMat4 view_from_world{1};
    Mat4 clip_from_view{1};  ///< GL's clip space: z from -w to w

    bool operator==(const Camera&) const = default;
};

enum class Output : std::uint8_t {
    display_srgb,  ///< filmic curve and sRGB, for an 8-bit framebuffer
    linear_hdr,    ///< scene radiance, linear with sRGB's primaries, for a floating-point framebuffer
};

/// What stands behind the characters.
enum class Backdrop : std::uint8_t {
    color,  ///< ViewFrame::background_linear: every pixel of the view is written
    keep,   ///< what the framebuffer holds: the picture, premultiplied with its opacity, is laid over it
};

/// How the view works together with the depth of its framebuffer.
enum class HostDepth : std::uint8_t {
    none,            ///< neither read nor written
    read,            ///< what the host drew nearer hides the characters
    read_and_write,  ///< and what the host draws later is hidden by them
};

struct ViewFrame {
    Camera camera;
    DepthConvention depth_convention;     ///< of camera.clip_from_view and of the framebuffer's depth
    std::uint32_t x = 0, y = 0;           ///< pixels, lower left corner of the view in the framebuffer
    std::uint32_t width = 0, height = 0;  ///< pixels
    std::uint32_t framebuffer = 0;        ///< GL name; 0: the default framebuffer
    Backdrop backdrop = Backdrop::color;
    HostDepth host_depth = HostDepth::none;
    /// GL name of a framebuffer that gets, in the view's rectangle, how far what is seen of the characters has moved
    /// since the frame before: to the first draw buffer, x and y in widths and heights of the view (rg16f or finer);
    /// other pixels stay as they are, and so do all in the first frame after a cut. 0: none. Not the one that is drawn
    /// to.
    std::uint32_t velocity_framebuffer = 0;
    Output output = Output::display_srgb;
    float exposure = 1;  ///< factor on radiance before the filmic curve
    /// In place of the scene's for this view: alive while drawing. Null: the scene's.
    const Lighting* lighting = nullptr;
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

struct FrameState;

/// What a picture keeps from frame to frame: settings of its camera and its antialiasing, its last frame, its exposure.
/// One for each eye, screen, mirror. Drawn by Scene::draw.
class View {
public:
    static Result<View> create(const Device& device);

    /// Status: no such effect, setting or choice, or one that another owner has (runtime/settings.h).
    Status set(std::string_view setting, std::string_view choice);

    FrameState& state() { return *state_; }
    const FrameState& state() const { return *state_; }

private:
    explicit View(std::shared_ptr<FrameState> state);
    std::shared_ptr<FrameState> state_;
};

}  // namespace blush
