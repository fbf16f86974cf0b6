#pragma once
/// What a Device holds: the inside that everything drawn on it shares.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/device.h"
#include "runtime/frame/store.h"
#include "runtime/gl/current_context.h"
#include "runtime/gl/deletions.h"
#include "runtime/gl/program.h"
#include "runtime/gl/texture_pool.h"

namespace blush {

struct AssetState;
struct FaceModel;

struct DeviceState {
    DeviceState() = default;
    DeviceState(const DeviceState&) = delete;
    DeviceState& operator=(const DeviceState&) = delete;
    ~DeviceState();

    DeviceInfo info;
    void* own_display = nullptr;  ///< EGL's, of a context of our own
    void* own_context = nullptr;  ///< null: the host's was adopted
    gl::ContextName context;      ///< that all objects are of
    std::vector<std::string> messages;

    gl::ProgramCache programs;
    gl::Deletions deletions;
    gl::TexturePool textures;       ///< transient ones, of every frame that is drawn on the device
    std::uint32_t kept_states = 0;  ///< HostStates that live
    Store store;
    /// Of the assets that characters on this device show.
    std::map<const AssetState*, std::weak_ptr<FaceModel>> models;

    /// Makes an own context current; of an adopted one, which its host makes current, it does nothing. Deletes what
    /// waits for it.
    void enter();
    bool is_current() const { return gl::current_context() == context; }
    /// For the scope of a destructor: objects go at once where their context is current, else when it next is.
    gl::Deletions* deletions_unless_current() { return is_current() ? nullptr : &deletions; }
};

/// Holds an object that has a `device`: its GL objects go in the device's context, or wait for it.
template <class T>
std::shared_ptr<T> on_device(T* object) {
    return std::shared_ptr<T>(object, [](T* going) {
        const Device device = going->device;  // outlives what it is the device of
        const gl::DeletionScope scope(device.state().deletions_unless_current());
        delete going;
    });
}

}  // namespace blush
