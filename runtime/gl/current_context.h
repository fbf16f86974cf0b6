#pragma once
/// Which GL context is current, whoever made it.

namespace blush::gl {

/// A context of EGL or of GLX, by its handle in that API; none: both null.
struct ContextName {
    void* egl = nullptr;
    void* glx = nullptr;

    bool exists() const { return egl != nullptr || glx != nullptr; }
    bool operator==(const ContextName&) const = default;
};

/// The one that is current on this thread. (Calling any GL function without one ends the process inside libepoxy, so
/// this has to be asked first.)
ContextName current_context();

}  // namespace blush::gl
