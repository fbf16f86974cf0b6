#pragma once
/// The window of `blush play`: orbit, zoom, pause, scrub, step, speed, screenshot.

#include <string>

#include "tools/blush/performing.h"
#include "tools/blush/shot.h"

namespace blush::tool {

struct ViewerOptions {
    std::string face;
    std::string performance;  ///< as find_performance() takes it
    PoseOptions pose;
    PerformOptions perform;
    ShotOptions shot;      ///< size: of the picture beside the panel, window coordinates
    bool captions = true;  ///< the performance's words, over the picture
    float from_seconds = 0;
    float to_seconds = -1;        ///< negative: to the end
    double frames_a_second = 30;  ///< of single steps
    /// Ends by itself after that many frames (for tests); 0: when the user closes the window.
    int frames = 0;
};

/// Returns the exit status. Error on standard error: no display, no OpenGL 4.5.
int run_viewer(const ViewerOptions& options);

/// True when a window can be opened here (DISPLAY or WAYLAND_DISPLAY is set).
bool have_display();

}  // namespace blush::tool
