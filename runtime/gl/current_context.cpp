#include "runtime/gl/current_context.h"

// X11's headers define macros called Status and None, so this file includes nothing of ours but its own header.
#include <epoxy/egl.h>
#include <epoxy/glx.h>

namespace blush::gl {

ContextName current_context() {
    const EGLContext egl = eglGetCurrentContext();
    return {egl == EGL_NO_CONTEXT ? nullptr : egl, glXGetCurrentContext()};
}

}  // namespace blush::gl
