#pragma once
/// The panel at the window's left edge: Dear ImGui drawn over the finished frame.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/measure/portrait.h"
#include "tools/blush/viewer_input.h"

struct GLFWwindow;
struct ImFont;

namespace blush::tool {

class Panel {
public:
    /// Also takes part in the window's input: its callbacks are added to those that are set. text_scale: of a text of
    /// usual size. Error: Dear ImGui finds no GL.
    static Result<std::unique_ptr<Panel>> create(GLFWwindow* window, float text_scale);
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    /// Width in window coordinates, wherever the window is at least twice as wide; else half the window.
    float width() const { return width_; }

    struct Shown {
        Portrait& character;
        const FrameReport& report;
        float frame_milliseconds;
        std::string_view caption;  ///< words to be seen; may be empty
    };
    /// Draws into the default framebuffer, and changes the state where the user touches the panel. Draws nothing while
    /// the panel is hidden.
    void draw(const Shown& shown, ViewerState& state);

    /// The user wants the time of each pass (ViewFrame::timed).
    bool passes_timed() const { return passes_timed_; }

private:
    explicit Panel(float text_scale);
    void draw_caption(std::string_view caption, bool panel_shown) const;
    void draw_clock(PlaybackClock& clock);
    void draw_controls(Portrait& character, ViewerState& state);
    void draw_control(std::uint32_t control, Portrait& character, ViewerState& state);
    void draw_effects(const FrameReport& report);
    void draw_passes(const FrameReport& report);

    float width_;
    ImFont* caption_font_ = nullptr;
    bool passes_timed_ = false;
    std::string filter_;
    std::vector<std::uint32_t> listed_controls_;  // whose names the filter lets through
    bool listed_current_ = false;
};

}  // namespace blush::tool
