#pragma once
/// Device: the GL context that everything else lives in.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "rig/result.h"

namespace blush {

struct DeviceState;

struct DeviceInfo {
    std::string renderer, version;
    int largest_sample_count = 1;  ///< of a multisampled floating-point colour target
    int largest_texture_side_texels = 0;
    int texture_units = 16;  ///< of a fragment shader
    std::uint64_t largest_storage_block_bytes = 0;
};

/// A GL 4.5 core context: one of our own without a window (EGL), or the host's. A Device is a handle: copies share the
/// context, and every Character, Scene and View keeps one, so that an own context lives as long as anything that needs
/// it. Use it, and all that was made with it, from one thread at a time. What was made with it may be destroyed on any
/// thread, whatever context is current there: its GL objects go when the device is next used.
class Device {
public:
    /// Makes a context on the surfaceless EGL platform. debug: collect the driver's messages (debug_messages()).
    /// Error: no EGL, no surfaceless platform, or no OpenGL 4.5.
    static Result<Device> headless(bool debug = true);

    /// Uses the context that is current on this thread, which must be current whenever something is made or drawn with
    /// the device. Error: no current context, or one below OpenGL 4.5. GL functions are found through libepoxy, by
    /// themselves.
    static Result<Device> adopt_current();

    const DeviceInfo& info() const;

    /// Makes an own context current on this thread; of an adopted one it does nothing.
    void make_current() const;

    /// High-severity messages of the driver since the device was made (headless with `debug` only).
    std::span<const std::string> debug_messages() const;

    DeviceState& state() const { return *state_; }

private:
    explicit Device(std::shared_ptr<DeviceState> state);
    std::shared_ptr<DeviceState> state_;
};

/// Keeps the GL state of the host while it lives, and restores it at the end: draws, depth passes and the like within
/// its scope neither save nor restore anything themselves. Nobody else may touch the state in between. The device's
/// context is current when it begins and when it ends.
class HostState {
public:
    explicit HostState(const Device& device);
    ~HostState();
    HostState(const HostState&) = delete;
    HostState& operator=(const HostState&) = delete;

private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

}  // namespace blush
