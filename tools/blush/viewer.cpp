#include "tools/blush/viewer.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/files/output_file.h"
#include "runtime/offscreen.h"
#include "tools/blush/commands.h"
#include "tools/blush/playback.h"
#include "tools/blush/viewer_panel.h"
#include "tools/blush/viewer_window.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

/// The first of "name_0001.png", "name_0002.png", ... in the current folder that does not exist.
fs::path free_picture_name(const std::string& name) {
    for (unsigned number = 1;; ++number) {
        std::string digits = std::to_string(number);
        digits.insert(0, 4 - std::min<std::size_t>(4, digits.size()), '0');
        const fs::path path = name + "_" + digits + ".png";
        std::error_code failed;
        if (!fs::exists(path, failed)) return path;
    }
}

/// The loop, and what it draws.
class Viewer {
public:
    Viewer(const ViewerOptions& options, Size picture, Window& window, Panel& panel, Device device, Portrait& character,
           Playback& playback, PlaybackClock clock, std::optional<Lighting> lighting)
        : options_(options),
          picture_(picture),
          window_(window),
          panel_(panel),
          device_(std::move(device)),
          character_(character),
          playback_(playback),
          lighting_(std::move(lighting)),
          name_(fs::path(options.face).stem().string()),
          performed_(playback.performer().timeline() ? playback.performer().timeline()->performance().name
                                                     : fs::path(options.perform.script).stem().string()) {
        state_.clock = clock;
        state_.held_controls.resize(character.rig().control_names().size());
    }

    int run() {
        const float panel_width = panel_.width();
        window_.show({picture_.width + static_cast<std::uint32_t>(panel_width), picture_.height});
        const bool counted = options_.frames > 0;
        int frames = 0;
        double last_seconds = glfwGetTime();
        while (!counted || frames < options_.frames) {
            if (!counted && idle()) {
                window_.wait(state_);
                last_seconds = glfwGetTime();  // time spent waiting is not played
                frames_since_event_ = 0;
            } else {
                window_.poll(state_);
            }
            if (state_.quit_wanted) return 0;
            const double now_seconds = glfwGetTime();
            const double fixed_seconds = frames == 0 ? 0 : 1 / options_.frames_a_second;
            state_.clock.advance(counted ? fixed_seconds : now_seconds - last_seconds);
            last_seconds = now_seconds;
            if (const int found = frame(); found != 0) return found;
            ++frames;
        }
        std::cout << frames_drawn_ << " frames of " << last_drawn_.width << "x" << last_drawn_.height << "\n";
        return 0;
    }

private:
    /// The script's error, once; the face stays where it was, and the rest goes on.
    void complain(const Error& error) {
        if (error.message != complaint_) fail(error);
        complaint_ = error.message;
    }

    /// Nothing moves and the panel has settled, or there is nothing to draw into.
    bool idle() const {
        constexpr int frames_to_settle = 3;  // Dear ImGui answers an event over up to two frames
        const Size pixels = window_.pixels();
        return pixels.width == 0 || pixels.height == 0 ||
               (!state_.clock.playing && frames_since_event_ >= frames_to_settle);
    }

    /// The part of the window that the panel leaves free, and a view of the whole window with the face in the middle of
    /// that part.
    struct Place {
        Size free;
        ViewFrame view;
    };
    Place place(Size pixels) {
        const auto panel_pixels = static_cast<std::uint32_t>(panel_.width() * window_.pixels_a_unit());
        const std::uint32_t taken = state_.panel_shown ? std::min(panel_pixels, pixels.width / 2) : 0;
        Place place;
        place.free = {pixels.width - taken, pixels.height};
        place.view.width = pixels.width;
        place.view.height = pixels.height;
        options_.shot.apply(place.view);
        place.view.timed = panel_.passes_timed();
        if (lighting_) place.view.lighting = &*lighting_;
        place.view.time_seconds = state_.clock.time_seconds;
        place.view.frame_number =
            static_cast<std::uint32_t>(std::max(state_.clock.time_seconds * options_.frames_a_second, 0.0));
        window_.home = options_.shot.camera(character_, place.free.aspect());
        if (state_.camera_is_home) state_.camera = window_.home;
        place.view.camera = state_.camera.camera(pixels.aspect());
        // Clip coordinates reach from -1 to 1, so that a shift of `taken` / 2 pixels is this:
        const float shift = static_cast<float>(taken) / static_cast<float>(pixels.width);
        place.view.camera.clip_from_view =
            glm::translate(glm::mat4(1), glm::vec3(shift, 0, 0)) * place.view.camera.clip_from_view;
        return place;
    }

    int frame() {
        const double start_seconds = glfwGetTime();
        if (Status played = playback_.seek(state_.clock.time_seconds); !played) complain(played.error());
        apply_held(state_, character_.controls());
        const Size pixels = window_.pixels();
        if (pixels.width == 0 || pixels.height == 0) return 0;

        Place here = place(pixels);
        // A jump in time is a cut: the end of the loop, or a hand on the time line.
        constexpr double longest_frame_seconds = 0.25;
        const double passed_seconds = (state_.clock.time_seconds - drawn_time_seconds_) / state_.clock.speed;
        here.view.cut = passed_seconds < 0 || passed_seconds > longest_frame_seconds;
        drawn_time_seconds_ = state_.clock.time_seconds;
        const FrameReport& report = character_.draw(here.view);
        if (Status good = finite(report); !good) return fail(good.error());
        const std::string_view words = options_.captions ? playback_.performer().caption() : std::string_view();
        panel_.draw({character_, report, frame_milliseconds_, words}, state_);
        if (state_.screenshot_wanted) take_screenshot(here.free);
        state_.screenshot_wanted = false;
        set_title();
        window_.present(options_.frames == 0);
        ++frames_since_event_;
        ++frames_drawn_;
        last_drawn_ = pixels;

        constexpr float share_of_new = 0.1F;  // a figure that can be read while it changes
        const float milliseconds = static_cast<float>(1000 * (glfwGetTime() - start_seconds));
        frame_milliseconds_ += (frame_milliseconds_ == 0 ? 1 : share_of_new) * (milliseconds - frame_milliseconds_);
        return 0;
    }

    /// What the window shows beside the panel.
    void take_screenshot(Size size) {
        const fs::path path = free_picture_name(name_);
        Result<Offscreen> offscreen = Offscreen::create(device_, size.width, size.height, Output::display_srgb);
        if (!offscreen) {
            fail(offscreen.error());
            return;
        }
        ViewFrame view = offscreen->view();
        options_.shot.apply(view);
        view.camera = state_.camera.camera(size.aspect());
        if (lighting_) view.lighting = &*lighting_;
        view.time_seconds = state_.clock.time_seconds;
        draw_alone(character_, view);
        if (Status written = write_image(path, offscreen->read()); !written) {
            fail(written.error());
            return;
        }
        std::cout << path.string() << ": " << size.width << "x" << size.height << ", sRGB" << std::endl;
    }

    /// Says what the panel says, for when it is hidden.
    void set_title() {
        std::string speed = std::to_string(state_.clock.speed);
        speed.erase(speed.find_last_not_of("0.") + 1);
        std::string title = "blush: " + name_ + ", " + performed_;
        if (state_.clock.speed != 1) title += ", x" + speed;
        if (!state_.clock.playing) title += ", paused";
        if (const std::string_view words = playback_.performer().caption(); !words.empty()) {
            title += ": \"" + std::string(words) + "\"";
        }
        if (title != title_) window_.set_title(title);
        title_ = std::move(title);
    }

    const ViewerOptions& options_;
    Size picture_;  // beside the panel, window coordinates
    Window& window_;
    Panel& panel_;
    Device device_;
    Portrait& character_;
    Playback& playback_;
    std::optional<Lighting> lighting_;  // of the options; else three lights of a portrait
    std::string name_, performed_, title_, complaint_;
    ViewerState state_;
    int frames_since_event_ = 0, frames_drawn_ = 0;
    Size last_drawn_;  // pixels
    float frame_milliseconds_ = 0;
    double drawn_time_seconds_ = 0;
};

}  // namespace

namespace {

Result<PlaybackClock> clock_of(const FaceFiles& files, const ViewerOptions& options) {
    const Face& face = files.face;
    const Rig rig(face, files.rig);
    std::optional<BoundPerformance> timeline;
    if (!options.performance.empty() || options.perform.script.empty()) {
        Result<Performance> performance = find_performance(face, options.performance);
        if (!performance) return performance.error();
        timeline.emplace(*std::move(performance), rig);
    }
    Result<PerformerParts> parts = options.perform.parts(face, rig, {}, std::move(timeline));
    if (!parts) return parts.error();
    Performer performer(rig, *std::move(parts));
    constexpr float endless_seconds = 600;  // somebody who only looks on has seen enough by then
    const Result<float> duration = duration_of(performer, endless_seconds);
    if (!duration) return duration.error();
    return make_clock(options.from_seconds, options.to_seconds, std::max(*duration, options.to_seconds),
                      options.frames_a_second);
}

}  // namespace

bool have_display() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

int run_viewer(const ViewerOptions& options) {
    if (!have_display()) {
        return fail(
            {"there is no display for a window (DISPLAY and WAYLAND_DISPLAY are not set); -o plays into files"});
    }
    // All input first: a bad file should not flash a window.
    const Result<Size> size = parse_size(options.shot.size);
    if (!size) return fail(size.error());
    Result<FaceFiles> files = load_face_files(options.face, options.pose.rig_file);
    if (!files) return fail(files.error());
    const Result<PlaybackClock> clock = clock_of(*files, options);
    if (!clock) return fail(clock.error());

    Result<std::unique_ptr<Window>> window = Window::open("blush");
    if (!window) return fail(window.error());
    Result<Device> device = Device::adopt_current();
    if (!device) return fail(device.error());
    Result<Portrait> character = make_character(*device, *std::move(files), options.pose);
    if (!character) return fail(character.error());
    const Result<std::optional<BoundPerformance>> timeline =
        find_timeline(character->face(), character->rig(), options.performance, options.perform);
    if (!timeline) return fail(timeline.error());
    Result<PerformerParts> parts =
        options.perform.parts(character->face(), character->rig(), character->controls(), *timeline);
    if (!parts) return fail(parts.error());
    Playback playback(*character, *std::move(parts));
    Result<std::optional<Lighting>> lighting =
        options.shot.light.lighting(character->face(), millimetres_a_unit(*character));
    if (!lighting) return fail(lighting.error());
    Result<std::unique_ptr<Panel>> panel = Panel::create((*window)->handle(), (*window)->text_scale());
    if (!panel) return fail(panel.error());
    return Viewer(options, *size, **window, **panel, *device, *character, playback, *clock, *std::move(lighting)).run();
}

}  // namespace blush::tool
