#include "tools/blush/viewer.h"

#include <cstdlib>

namespace blush::tool {

bool have_display() { return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr; }

int run_viewer(const ViewerOptions& /*options*/) {
    return fail({"there is no window yet; use -o"});
}

}  // namespace blush::tool
