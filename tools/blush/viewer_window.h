#pragma once
/// The window: GLFW, an OpenGL 4.5 core context that is current while it lives, and the user's keys and mouse.

#include <cstdint>
#include <memory>
#include <string>

#include "tools/blush/picture_size.h"
#include "tools/blush/viewer_input.h"

struct GLFWwindow;

namespace blush::tool {

class Window {
public:
    /// Opens a window that is not yet shown and makes its context current. At most one at a time (GLFW is global).
    /// Error: no display can be opened, or none with OpenGL 4.5.
    static Result<std::unique_ptr<Window>> open(const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }

    /// Shows the window at a size in window coordinates, or at the screen's if that is smaller.
    void show(Size size);
    void set_title(const std::string& title);
    /// Shows what was drawn. wait_for_display: no more often than the display shows pictures.
    void present(bool wait_for_display);

    /// Handles what has happened / first waits until something does. Both change the state and quit_wanted in it.
    void poll(ViewerState& state);
    void wait(ViewerState& state);

    /// Of the framebuffer, pixels; 0x0 while there is nothing to be seen.
    Size pixels() const;
    /// Pixels to a window coordinate; 1 on most X11 displays, 2 on many others.
    float pixels_a_unit() const;
    /// How much larger than usual the user wants text and margins, in window coordinates.
    float text_scale() const;

    /// Limits how near and far the wheel goes: the camera that frames the face.
    OrbitCamera home;

private:
    explicit Window(GLFWwindow* window);
    friend struct WindowCallbacks;

    GLFWwindow* window_;
    ViewerState* state_ = nullptr;  // only within poll() and wait()
    Drag dragging_ = Drag::none;
    double pointer_x_ = 0, pointer_y_ = 0;
    int swap_interval_ = -1;
};

}  // namespace blush::tool
