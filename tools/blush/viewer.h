#pragma once
/// The window of `blush play`: orbit, zoom, pause, scrub, step, speed, screenshot.

#include "tools/blush/options.h"
#include "tools/blush/performing.h"

namespace blush::tool {

struct ViewerOptions {
    std::string face;
    std::string performance;  ///< as find_performance() takes it
    PoseOptions pose;
    PerformOptions perform;
    LightOptions light;
    bool captions = true;                     ///< the performance's words, over the picture
    std::uint32_t width = 960, height = 960;  ///< of the picture beside the panel, window coordinates
    float from_seconds = 0;
    float to_seconds = -1;        ///< negative: to the end
    double frames_a_second = 30;  ///< of single steps
    bool check_finite = false;
    /// Ends by itself after that many frames (for tests); 0: when the user closes the window.
    int frames = 0;
};

/// Returns the exit status. Error on standard error: no display, no OpenGL 4.5.
int run_viewer(const ViewerOptions& options);

/// True when a window can be opened here (DISPLAY or WAYLAND_DISPLAY is set).
bool have_display();

}  // namespace blush::tool
