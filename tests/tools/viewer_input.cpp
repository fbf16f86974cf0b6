#include "tools/blush/viewer_input.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace blush::tool {
namespace {

constexpr double view_height = 500;

ViewerState looking_at_a_head() {
    ViewerState state;
    state.clock = {.from_seconds = 0, .to_seconds = 2, .frames_a_second = 4};
    state.camera = {.target_world = {0.1F, 1.6F, 0.05F}, .distance = 0.8F, .scene_radius = 0.2F};
    return state;
}

/// Where a point of the world is drawn in a square view, pixels right and down of its middle.
glm::vec2 pixel_of(const OrbitCamera& orbit, glm::vec3 world) {
    const Camera camera = orbit.camera(1);
    const glm::vec4 clip = camera.clip_from_view * glm::mat4(camera.view_from_world) * glm::vec4(world, 1);
    return 0.5F * static_cast<float>(view_height) * glm::vec2(clip.x, -clip.y) / clip.w;
}

TEST(ViewerDrag, PannedPointStaysUnderThePointer) {
    for (const float yaw : {0.0F, 0.7F, -2.5F}) {
        for (const float pitch : {0.0F, 1.2F, -0.4F}) {
            ViewerState state = looking_at_a_head();
            state.camera.yaw_radians = yaw;
            state.camera.pitch_radians = pitch;
            const glm::vec3 grabbed(state.camera.target_world);
            drag(Drag::pan, 30, 17, view_height, state);
            const glm::vec2 pixel = pixel_of(state.camera, grabbed);
            EXPECT_NEAR(pixel.x, 30, 0.01F);
            EXPECT_NEAR(pixel.y, 17, 0.01F);
            EXPECT_FALSE(state.camera_is_home);
        }
    }
}

TEST(ViewerDrag, OrbitTurnsTheFrontOfTheFaceWithThePointer) {
    ViewerState state = looking_at_a_head();
    const glm::vec3 nose = glm::vec3(state.camera.target_world) + glm::vec3(0, 0, 0.1F);
    drag(Drag::orbit, 20, 0, view_height, state);
    EXPECT_GT(pixel_of(state.camera, nose).x, 1);
    EXPECT_NEAR(pixel_of(state.camera, nose).y, 0, 0.01F);
    state = looking_at_a_head();
    drag(Drag::orbit, 0, 20, view_height, state);
    EXPECT_GT(pixel_of(state.camera, nose).y, 1);
    EXPECT_EQ(state.camera.target_world, looking_at_a_head().camera.target_world);
    EXPECT_EQ(state.camera.distance, looking_at_a_head().camera.distance);
}

TEST(ViewerDrag, TheViewsHeightIsHalfATurn) {
    ViewerState state = looking_at_a_head();
    drag(Drag::orbit, -view_height / 2, 0, view_height, state);
    EXPECT_NEAR(state.camera.yaw_radians, std::numbers::pi_v<float> / 2, 1e-6F);
    for (int turn = 0; turn < 1000; ++turn) drag(Drag::orbit, view_height, 0, view_height, state);
    EXPECT_LE(std::abs(state.camera.yaw_radians), std::numbers::pi_v<float> + 1e-6F) << "turns do not add up";
}

TEST(ViewerDrag, PitchStopsBeforeThePoles) {
    ViewerState state = looking_at_a_head();
    drag(Drag::orbit, 0, 10 * view_height, view_height, state);
    EXPECT_EQ(state.camera.pitch_radians, 1.5F);
    drag(Drag::orbit, 0, -1, view_height, state);
    EXPECT_LT(state.camera.pitch_radians, 1.5F) << "comes back at once";
}

TEST(ViewerDrag, IgnoresWhatMakesNoSense) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    ViewerState state = looking_at_a_head();
    drag(Drag::none, 10, 10, view_height, state);
    drag(Drag::orbit, nan, 0, view_height, state);
    drag(Drag::pan, 10, 10, 0, state);
    EXPECT_TRUE(state.camera_is_home);
    EXPECT_EQ(state.camera.target_world, looking_at_a_head().camera.target_world);
    EXPECT_EQ(state.camera.yaw_radians, 0);
}

TEST(ViewerZoom, NotchesComeNearerAndGoBack) {
    const OrbitCamera home = looking_at_a_head().camera;
    ViewerState state = looking_at_a_head();
    zoom(1, home, state);
    EXPECT_FLOAT_EQ(state.camera.distance, 0.9F * home.distance);
    zoom(-1, home, state);
    EXPECT_FLOAT_EQ(state.camera.distance, home.distance);
    zoom(1e9, home, state);
    EXPECT_FLOAT_EQ(state.camera.distance, home.distance / 20);
    zoom(-1e9, home, state);
    EXPECT_FLOAT_EQ(state.camera.distance, home.distance * 20);
}

TEST(ViewerCommands, DoWhatTheirNamesSay) {
    ViewerState state = looking_at_a_head();
    apply(Command::play_or_pause, state);
    EXPECT_FALSE(state.clock.playing);
    apply(Command::step_forward, state);
    EXPECT_EQ(state.clock.time_seconds, 0.25);
    apply(Command::step_back, state);
    EXPECT_EQ(state.clock.time_seconds, 0);
    apply(Command::go_to_end, state);
    EXPECT_EQ(state.clock.time_seconds, 2);
    apply(Command::go_to_start, state);
    EXPECT_EQ(state.clock.time_seconds, 0);
    apply(Command::faster, state);
    EXPECT_EQ(state.clock.speed, 2);
    apply(Command::slower, state);
    EXPECT_EQ(state.clock.speed, 1);
    state.camera_is_home = false;
    apply(Command::reset_camera, state);
    EXPECT_TRUE(state.camera_is_home);
    apply(Command::show_or_hide_panel, state);
    EXPECT_FALSE(state.panel_shown);
    apply(Command::take_screenshot, state);
    EXPECT_TRUE(state.screenshot_wanted);
    EXPECT_FALSE(state.quit_wanted);
    apply(Command::quit, state);
    EXPECT_TRUE(state.quit_wanted);
}

TEST(HeldControls, WriteOverThePerformanceUntilGivenBack) {
    ViewerState state;
    state.held_controls = {std::nullopt, 0.25F, 0.0F};
    std::array<float, 3> controls = {0.5F, 0.5F, 0.5F};
    apply_held(state, controls);
    EXPECT_EQ(controls, (std::array<float, 3>{0.5F, 0.25F, 0.0F})) << "held at zero is held, too";
    state.held_controls[1].reset();
    controls = {0.7F, 0.7F, 0.7F};
    apply_held(state, controls);
    EXPECT_EQ(controls, (std::array<float, 3>{0.7F, 0.7F, 0.0F}));
}

}  // namespace
}  // namespace blush::tool
