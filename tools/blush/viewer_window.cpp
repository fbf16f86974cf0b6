#include "tools/blush/viewer_window.h"

#include <algorithm>
#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

namespace blush::tool {
namespace {

std::string glfw_reason() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description ? description : "no reason given";
}

std::optional<Command> command_of(int key) {
    switch (key) {
        case GLFW_KEY_SPACE:
            return Command::play_or_pause;
        case GLFW_KEY_LEFT:
            return Command::step_back;
        case GLFW_KEY_RIGHT:
            return Command::step_forward;
        case GLFW_KEY_HOME:
            return Command::go_to_start;
        case GLFW_KEY_END:
            return Command::go_to_end;
        case GLFW_KEY_UP:
            return Command::faster;
        case GLFW_KEY_DOWN:
            return Command::slower;
        case GLFW_KEY_R:
            return Command::reset_camera;
        case GLFW_KEY_S:
            return Command::take_screenshot;
        case GLFW_KEY_H:
            return Command::show_or_hide_panel;
        case GLFW_KEY_ESCAPE:
        case GLFW_KEY_Q:
            return Command::quit;
        default:
            return std::nullopt;
    }
}

bool repeats(Command command) { return command == Command::step_back || command == Command::step_forward; }

}  // namespace

/// GLFW's callbacks. They are set before those of Dear ImGui, which calls them, too; what belongs to the panel is left
/// to it.
struct WindowCallbacks {
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

    static void key(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
        Window& self = of(window);
        // Control, Alt and Super belong to the desktop; letters belong to a text field that is being typed into.
        constexpr int others = GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
        if (!self.state_ || action == GLFW_RELEASE || (modifiers & others) != 0 || ImGui::GetIO().WantTextInput) return;
        const std::optional<Command> command = command_of(key);
        if (command && (action == GLFW_PRESS || repeats(*command))) apply(*command, *self.state_);
    }

    static void mouse_button(GLFWwindow* window, int button, int action, int /*modifiers*/) {
        Window& self = of(window);
        if (action == GLFW_RELEASE) {
            self.dragging_ = Drag::none;
        } else if (self.state_ && !ImGui::GetIO().WantCaptureMouse) {
            self.dragging_ = button == GLFW_MOUSE_BUTTON_LEFT ? Drag::orbit : Drag::pan;
            glfwGetCursorPos(window, &self.pointer_x_, &self.pointer_y_);
        }
    }

    static void pointer(GLFWwindow* window, double x, double y) {
        Window& self = of(window);
        int width = 0, height = 0;
        glfwGetWindowSize(window, &width, &height);
        if (self.state_) drag(self.dragging_, x - self.pointer_x_, y - self.pointer_y_, height, *self.state_);
        self.pointer_x_ = x;
        self.pointer_y_ = y;
    }

    static void wheel(GLFWwindow* window, double /*right*/, double up) {
        Window& self = of(window);
        if (self.state_ && !ImGui::GetIO().WantCaptureMouse) zoom(up, self.home, *self.state_);
    }
};

Result<std::unique_ptr<Window>> Window::open(const std::string& title) {
    if (!glfwInit()) return Error{"no window can be opened here: " + glfw_reason()};
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // The frame is drawn into textures; only its last pass reaches the window, which needs colour alone.
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    constexpr int any_size = 64;
    GLFWwindow* window = glfwCreateWindow(any_size, any_size, title.c_str(), nullptr, nullptr);
    if (!window) {
        // Some X servers (of remote desktops, above all) speak no GLX; EGL needs nothing of them.
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
        window = glfwCreateWindow(any_size, any_size, title.c_str(), nullptr, nullptr);
    }
    if (!window) {
        const std::string reason = glfw_reason();
        glfwTerminate();
        return Error{"this display offers no OpenGL 4.5 core context: " + reason};
    }
    glfwMakeContextCurrent(window);
    return std::unique_ptr<Window>(new Window(window));
}

Window::Window(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, WindowCallbacks::key);
    glfwSetMouseButtonCallback(window, WindowCallbacks::mouse_button);
    glfwSetCursorPosCallback(window, WindowCallbacks::pointer);
    glfwSetScrollCallback(window, WindowCallbacks::wheel);
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::show(Size size) {
    int left = 0, top = 0, width = static_cast<int>(size.width), height = static_cast<int>(size.height);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        int most_width = 0, most_height = 0;
        glfwGetMonitorWorkarea(monitor, &left, &top, &most_width, &most_height);
        if (most_width > 0 && most_height > 0) {
            width = std::min(width, most_width);
            height = std::min(height, most_height);
        }
    }
    glfwSetWindowSize(window_, width, height);
    glfwShowWindow(window_);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::present(bool wait_for_display) {
    const int interval = wait_for_display ? 1 : 0;
    if (interval != swap_interval_) glfwSwapInterval(interval);
    swap_interval_ = interval;
    glfwSwapBuffers(window_);
}

void Window::poll(ViewerState& state) {
    state_ = &state;
    glfwPollEvents();
    state_ = nullptr;
    state.quit_wanted = state.quit_wanted || glfwWindowShouldClose(window_);
}

void Window::wait(ViewerState& state) {
    state_ = &state;
    glfwWaitEvents();
    state_ = nullptr;
    state.quit_wanted = state.quit_wanted || glfwWindowShouldClose(window_);
}

Size Window::pixels() const {
    if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return {0, 0};
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))};
}

float Window::pixels_a_unit() const {
    int units = 0, pixels = 0, ignored = 0;
    glfwGetWindowSize(window_, &units, &ignored);
    glfwGetFramebufferSize(window_, &pixels, &ignored);
    return units > 0 && pixels > 0 ? static_cast<float>(pixels) / static_cast<float>(units) : 1.0F;
}

float Window::text_scale() const {
    float across = 1, along = 1;
    glfwGetWindowContentScale(window_, &across, &along);
    // Where a window coordinate is several pixels wide already, the content scale is, or is partly, in it.
    return std::clamp(across / pixels_a_unit(), 1.0F, 4.0F);
}

}  // namespace blush::tool
