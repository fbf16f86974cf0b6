#include "runtime/gl/current_context.h"

// X11's headers define macros called Status and None, so this file includes nothing of ours but its own header.
#include <epoxy/egl.h>
#include <epoxy/glx.h>

namespace blush::gl {

bool context_is_current() { return eglGetCurrentContext() != EGL_NO_CONTEXT || glXGetCurrentContext() != nullptr; }

}  // namespace blush::gl
