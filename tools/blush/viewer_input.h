#pragma once
/// What keys and the mouse do to the viewer's state. Pure: no window, no GL.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/camera.h"
#include "tools/blush/viewer_clock.h"

namespace blush::tool {

enum class Command : std::uint8_t {
    play_or_pause,
    step_back,
    step_forward,
    go_to_start,
    go_to_end,
    faster,
    slower,
    reset_camera,
    take_screenshot,
    show_or_hide_panel,
    quit,
};

struct ViewerState {
    PlaybackClock clock;
    /// One for each control of the rig: the value that the user holds it at, against the performance.
    std::vector<std::optional<float>> held_controls;
    OrbitCamera camera;
    /// The user has not moved the camera since it was last reset: it follows the window's shape.
    bool camera_is_home = true;
    bool panel_shown = true;
    bool screenshot_wanted = false;
    bool quit_wanted = false;
};

void apply(Command command, ViewerState& state);

/// Writes the values that the user holds over those of the performance. controls: one value for each control of the
/// rig.
void apply_held(const ViewerState& state, std::span<float> controls);

enum class Drag : std::uint8_t { none, orbit, pan };

/// Movement of the pointer in the units of `view_height` (window coordinates); right and down are positive.
/// The scene follows the pointer: what is panned stays under it at the camera's target, and the height of the view is
/// half a turn.
void drag(Drag kind, double right, double down, double view_height, ViewerState& state);

/// notches: of the wheel; positive brings the camera nearer. `home` limits the distance, to 1/20 and 20 times its own.
void zoom(double notches, const OrbitCamera& home, ViewerState& state);

}  // namespace blush::tool
