#include "runtime/device.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <vector>

#include "runtime/frame/device_state.h"
#include "runtime/gl/state_guard.h"

namespace blush {

DeviceState::~DeviceState() {
    if (own_context == nullptr) {
        if (is_current()) {
            deletions.carry_out();
            programs.clear();
            return;
        }
        // The host's objects are safe from us: ours stay until its context goes.
        const gl::DeletionScope scope(&deletions);
        textures = {};
        store = {};
        return;
    }
    const gl::DeletionScope scope(&deletions);  // they go with their context
    textures = {};
    store = {};
    if (eglGetCurrentContext() == own_context) {
        eglMakeCurrent(own_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    // The display is shared by every device of the process, so it is not terminated.
    eglDestroyContext(own_display, own_context);
}

void DeviceState::enter() {
    programs.make_current();
    if (own_context != nullptr && eglGetCurrentContext() != own_context) {
        eglMakeCurrent(own_display, EGL_NO_SURFACE, EGL_NO_SURFACE, own_context);
    }
    if (is_current()) deletions.carry_out();
}

namespace {

void GLAPIENTRY collect_message(GLenum /*source*/, GLenum /*type*/, GLuint /*id*/, GLenum severity, GLsizei length,
                                const GLchar* message, const void* user) {
    if (severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto* messages = static_cast<std::vector<std::string>*>(const_cast<void*>(user));
    constexpr std::size_t enough = 64;  // a message a frame would otherwise grow without end
    if (messages->size() < enough) messages->emplace_back(message, static_cast<std::size_t>(length));
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

Status read_info(DeviceInfo& info) {
    constexpr int needed_version = 45;
    if (!epoxy_is_desktop_gl() || epoxy_gl_version() < needed_version) {
        return Error{"the GL context is \"" + gl_string(GL_VERSION) + "\"; blush needs OpenGL 4.5"};
    }
    info.renderer = gl_string(GL_RENDERER);
    info.version = gl_string(GL_VERSION);
    GLint vertex_blocks = 0;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &vertex_blocks);
    constexpr GLint needed_blocks = 6;  // shaders/deform/deform.vert
    if (vertex_blocks < needed_blocks) {
        return Error{info.renderer + " offers " + std::to_string(vertex_blocks) +
                     " storage blocks to a vertex shader; the deformation needs " + std::to_string(needed_blocks)};
    }
    glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA16F, GL_SAMPLES, 1, &info.largest_sample_count);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &info.largest_texture_side_texels);
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &info.texture_units);
    info.texture_units = std::min(info.texture_units, static_cast<int>(gl::StateGuard::texture_units));
    GLint64 block_bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_bytes);
    info.largest_storage_block_bytes = static_cast<std::uint64_t>(block_bytes);
    return Done{};
}

}  // namespace

Device::Device(std::shared_ptr<DeviceState> state) : state_(std::move(state)) {}

Result<Device> Device::headless(bool debug) {
    auto state = std::make_shared<DeviceState>();
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        return Error{"this machine's EGL has no surfaceless platform (Debian: libegl-mesa0 and libgl1-mesa-dri)"};
    }
    state->own_display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (state->own_display == EGL_NO_DISPLAY || !eglInitialize(state->own_display, nullptr, nullptr) ||
        !eglBindAPI(EGL_OPENGL_API)) {
        return Error{"EGL cannot start on the surfaceless platform (Debian: libegl-mesa0 and libgl1-mesa-dri)"};
    }
    const std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                              4,
                                              EGL_CONTEXT_MINOR_VERSION,
                                              5,
                                              EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                              EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                              EGL_CONTEXT_OPENGL_DEBUG,
                                              debug ? EGL_TRUE : EGL_FALSE,
                                              EGL_NONE};
    state->own_context = eglCreateContext(state->own_display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (state->own_context == EGL_NO_CONTEXT) return Error{"this machine's EGL offers no OpenGL 4.5 core context"};
    eglMakeCurrent(state->own_display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->own_context);
    state->context = gl::current_context();
    if (Status info = read_info(state->info); !info) return info.error();
    state->programs.make_current();
    if (debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(collect_message, &state->messages);
    }
    return Device(std::move(state));
}

Result<Device> Device::adopt_current() {
    if (!gl::current_context().exists()) return Error{"no GL context is current on this thread"};
    auto state = std::make_shared<DeviceState>();
    state->context = gl::current_context();
    if (Status info = read_info(state->info); !info) return info.error();
    state->programs.make_current();
    return Device(std::move(state));
}

const DeviceInfo& Device::info() const { return state_->info; }

void Device::make_current() const { state_->enter(); }

std::span<const std::string> Device::debug_messages() const { return state_->messages; }

struct HostState::Kept {
    explicit Kept(Device of) : device(std::move(of)) { ++device.state().kept_states; }
    ~Kept() { --device.state().kept_states; }
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;

    Device device;
    gl::DrawScope scope{device.state().kept_states == 0};
};

HostState::HostState(const Device& device) {
    device.make_current();
    kept_ = std::make_unique<Kept>(device);
}

HostState::~HostState() = default;

}  // namespace blush
