#pragma once
/// What tests with a GL context share: a device whose driver must have had nothing to say, and small pictures.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "runtime/device.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"
#include "tests/test_faces.h"

namespace blush::test {

inline void expect_no_debug_messages(const Device& device) {
    for (const std::string& message : device.debug_messages()) ADD_FAILURE() << "GL says: " << message;
}

/// Has a headless device; fails a test during which the driver reported an error.
class GlTest : public testing::Test {
protected:
    GlTest() : device_(make_device()) {}
    void TearDown() override { expect_no_debug_messages(device_); }

    static Device make_device() {
        Result<Device> device = Device::headless();
        if (!device) {
            ADD_FAILURE() << device.error().message;
            std::abort();  // every test of this fixture needs one
        }
        return *std::move(device);
    }
    Portrait make_character(Face face) const { return make_character(device_, std::move(face)); }
    static Portrait make_character(const Device& device, Face face) {
        Result<Portrait> character = Portrait::create(device, std::move(face));
        if (!character) {
            ADD_FAILURE() << character.error().message;
            std::abort();
        }
        return *std::move(character);
    }
    Offscreen make_offscreen(std::uint32_t width, std::uint32_t height, Output output = Output::display_srgb) const {
        Result<Offscreen> offscreen = Offscreen::create(device_, width, height, output);
        if (!offscreen) {
            ADD_FAILURE() << offscreen.error().message;
            std::abort();
        }
        return *std::move(offscreen);
    }

    Device device_;
};

inline void set_weights(Portrait& character, const std::vector<float>& weights) {
    std::ranges::copy(weights, character.controls().begin());
}

/// A view of `offscreen` that frames the character from the front, with every pass scanned for what is not finite.
inline ViewFrame framed_view(const Portrait& character, const Offscreen& offscreen) {
    ViewFrame view = offscreen.view();
    const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
    view.camera = character.framing(aspect).camera(aspect);
    view.check_finite = true;
    return view;
}

/// Draws and reads back; fails where a pass wrote what is not finite.
inline Image draw(Portrait& character, const Offscreen& offscreen, const ViewFrame& view) {
    const FrameReport& report = character.draw(view);
    if (report.not_finite) ADD_FAILURE() << report.not_finite->sentence();
    return offscreen.read();
}
inline Image draw(Portrait& character, const Offscreen& offscreen) {
    return draw(character, offscreen, framed_view(character, offscreen));
}

inline std::size_t colour_count(const Image& image) {
    std::set<std::uint32_t> colours;
    for (std::size_t p = 0; p + 3 < image.bytes.size(); p += 4) {
        colours.insert(static_cast<std::uint32_t>(image.bytes[p] << 16 | image.bytes[p + 1] << 8 | image.bytes[p + 2]));
    }
    return colours.size();
}

/// A lit, rounded face has hundreds of colours; a blank picture has one, a flat silhouette two.
constexpr std::size_t fewest_colours = 100;

}  // namespace blush::test
