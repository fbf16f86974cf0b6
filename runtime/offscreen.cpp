#include "runtime/offscreen.h"

#include <algorithm>

#include "runtime/frame/device_state.h"
#include "runtime/gl/object.h"
#include "runtime/gl/state_guard.h"

namespace blush {

struct Offscreen::State {
    explicit State(Device on) : device(std::move(on)) {}
    Device device;
    std::uint32_t width = 0, height = 0;
    Output output = Output::display_srgb;
    gl::Texture color;
    gl::Framebuffer framebuffer;
};

Offscreen::Offscreen(std::shared_ptr<State> state) : state_(std::move(state)) {}

Result<Offscreen> Offscreen::create(const Device& device, std::uint32_t width, std::uint32_t height, Output output) {
    const auto largest = static_cast<std::uint32_t>(device.info().largest_texture_side_texels);
    if (width == 0 || height == 0 || width > largest || height > largest) {
        return Error{"size " + std::to_string(width) + "x" + std::to_string(height) + ": a side may be 1 to " +
                     std::to_string(largest) + " pixels"};
    }
    device.make_current();
    auto state = on_device(new State(device));
    state->width = width;
    state->height = height;
    state->output = output;
    state->color = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(state->color.name(), 1, output == Output::display_srgb ? GL_RGBA8 : GL_RGBA16F,
                       static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    state->framebuffer = gl::make_framebuffer();
    glNamedFramebufferTexture(state->framebuffer.name(), GL_COLOR_ATTACHMENT0, state->color.name(), 0);
    return Offscreen(std::move(state));
}

ViewFrame Offscreen::view() const {
    ViewFrame view;
    view.width = state_->width;
    view.height = state_->height;
    view.framebuffer = state_->framebuffer.name();
    view.output = state_->output;
    return view;
}

Image Offscreen::read() const {
    state_->device.make_current();
    const gl::StateGuard guard;
    Image image;
    image.width = state_->width;
    image.height = state_->height;
    image.channels = 4;
    const std::size_t row = std::size_t{image.width} * 4;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, state_->framebuffer.name());
    const auto width = static_cast<GLsizei>(image.width), height = static_cast<GLsizei>(image.height);
    const auto flip = [&](auto& values) {
        for (std::size_t top = 0, bottom = image.height - 1; top < bottom; ++top, --bottom) {
            std::swap_ranges(values.begin() + static_cast<std::ptrdiff_t>(top * row),
                             values.begin() + static_cast<std::ptrdiff_t>((top + 1) * row),
                             values.begin() + static_cast<std::ptrdiff_t>(bottom * row));
        }
    };
    if (state_->output == Output::display_srgb) {
        image.bytes.resize(row * image.height);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.bytes.data());
        flip(image.bytes);
    } else {
        image.floats.resize(row * image.height);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, image.floats.data());
        flip(image.floats);
    }
    return image;
}

}  // namespace blush
