#pragma once

namespace blush::gl {

/// True when a GL context, of EGL or of GLX, is current on this thread. (Calling any GL function without one ends the
/// process inside libepoxy, so this has to be asked first.)
bool context_is_current();

}  // namespace blush::gl
