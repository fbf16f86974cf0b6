#include "tools/blush/viewer_input.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::tool {

void apply(Command command, ViewerState& state) {
    switch (command) {
        case Command::play_or_pause:
            state.clock.playing = !state.clock.playing;
            break;
        case Command::step_back:
            state.clock.step(-1);
            break;
        case Command::step_forward:
            state.clock.step(1);
            break;
        case Command::go_to_start:
            state.clock.scrub(state.clock.from_seconds);
            break;
        case Command::go_to_end:
            state.clock.scrub(state.clock.to_seconds);
            break;
        case Command::faster:
            state.clock.faster();
            break;
        case Command::slower:
            state.clock.slower();
            break;
        case Command::reset_camera:
            state.camera_is_home = true;
            break;
        case Command::take_screenshot:
            state.screenshot_wanted = true;
            break;
        case Command::show_or_hide_panel:
            state.panel_shown = !state.panel_shown;
            break;
        case Command::quit:
            state.quit_wanted = true;
            break;
    }
}

void apply_held(const ViewerState& state, std::span<float> controls) {
    for (std::size_t c = 0; c < std::min(state.held_controls.size(), controls.size()); ++c) {
        if (state.held_controls[c]) controls[c] = *state.held_controls[c];
    }
}

void drag(Drag kind, double right, double down, double view_height, ViewerState& state) {
    if (kind == Drag::none || !std::isfinite(right) || !std::isfinite(down) || !(view_height > 0)) return;
    state.camera_is_home = false;
    OrbitCamera& camera = state.camera;
    const float across = static_cast<float>(right / view_height), along = static_cast<float>(down / view_height);
    if (kind == Drag::orbit) {
        constexpr float half_turn = std::numbers::pi_v<float>, steepest = 1.5F;  // OrbitCamera's own limit
        camera.yaw_radians = std::remainder(camera.yaw_radians - half_turn * across, 2 * half_turn);
        camera.pitch_radians = std::clamp(camera.pitch_radians + half_turn * along, -steepest, steepest);
        return;
    }
    const float sin_yaw = std::sin(camera.yaw_radians), cos_yaw = std::cos(camera.yaw_radians);
    const float sin_pitch = std::sin(camera.pitch_radians), cos_pitch = std::cos(camera.pitch_radians);
    const glm::vec3 right_world(cos_yaw, 0, -sin_yaw);
    const glm::vec3 up_world(-sin_yaw * sin_pitch, cos_pitch, -cos_yaw * sin_pitch);
    const float height_world = 2 * camera.distance * std::tan(0.5F * camera.vertical_field_of_view_radians);
    camera.target_world += glm::dvec3(height_world * (along * up_world - across * right_world));
}

void zoom(double notches, const OrbitCamera& home, ViewerState& state) {
    if (notches == 0 || !std::isfinite(notches)) return;
    state.camera_is_home = false;
    constexpr float a_notch = 0.9F, range = 20;
    state.camera.distance = std::clamp(state.camera.distance * std::pow(a_notch, static_cast<float>(notches)),
                                       home.distance / range, home.distance * range);
}

}  // namespace blush::tool
