#pragma once
/// Device: the GL context that everything else lives in.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "rig/result.h"

namespace blush {

struct DeviceInfo {
    std::string renderer, version;
    int largest_sample_count = 1;  ///< of a multisampled floating-point colour target
    int largest_texture_side_texels = 0;
    std::uint64_t largest_storage_block_bytes = 0;
};

/// A GL 4.5 core context: one of our own without a window (EGL), or the host's. A Device is a handle: copies share the
/// context, and every Character keeps one, so that an own context lives as long as anything that needs it. Not
/// thread-safe; use it, and every Character made with it, from one thread at a time.
class Device {
public:
    /// Makes a context on the surfaceless EGL platform. debug: collect the driver's messages (debug_messages()).
    /// Error: no EGL, no surfaceless platform, or no OpenGL 4.5.
    static Result<Device> headless(bool debug = true);

    /// Uses the context that is current on this thread, which must stay alive, and current whenever the library is
    /// called. Error: no current context, or one below OpenGL 4.5. GL functions are found through libepoxy, by
    /// themselves.
    static Result<Device> adopt_current();

    const DeviceInfo& info() const;

    /// Makes an own context current on this thread; of an adopted one it does nothing.
    void make_current() const;

    /// High-severity messages of the driver since the device was made (headless with `debug` only).
    std::span<const std::string> debug_messages() const;

private:
    struct State;
    explicit Device(std::shared_ptr<State> state);
    std::shared_ptr<State> state_;
};

}  // namespace blush
