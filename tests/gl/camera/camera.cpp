// The camera's effects on the GPU: their twins, their laws, and pictures with holes in them.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/camera/bloom.h"
#include "rig/camera/depth_of_field.h"
#include "rig/camera/exposure.h"
#include "rig/camera/film_grain.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

using Picture = Map<glm::dvec3>;

/// Rows from the bottom, as the passes see them.
Picture radiance_of(const Image& image) {
    Picture picture(image.width, image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const float* texel = &image.floats[4 * (std::size_t{image.height - 1 - y} * image.width + x)];
            picture.at(x, y) = glm::dvec3(texel[0], texel[1], texel[2]);
        }
    }
    return picture;
}

/// Largest difference over the larger of 1 and the value.
double worst_difference(const Picture& a, const Picture& b) {
    double worst = 0;
    for (std::size_t p = 0; p < a.values.size(); ++p) {
        const glm::dvec3 d = glm::abs(a.values[p] - b.values[p]) / glm::max(glm::dvec3(1), glm::abs(b.values[p]));
        worst = std::max({worst, d.x, d.y, d.z});
    }
    return worst;
}

/// What the filmic curve of tone.frag makes of radiance, 0 to 255.
double display_byte(double radiance) {
    const auto filmic = [](double x) {
        return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.30;
    };
    const double c = std::clamp(filmic(2 * radiance) / filmic(11.2), 0.0, 1.0);
    return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

class CameraEffects : public test::GlTest {
protected:
    /// Nothing but the background.
    Portrait nothing() const {
        Face face = test::make_face({.side = 4, .targets = 0});
        for (Primitive& primitive : face.primitives) primitive.index_count = 0;
        return make_character(std::move(face));
    }
};

// Each level of the pyramid is rounded to half floats on its way, half an ulp of 2^-11 each, mostly to either side.
constexpr double bloom_tolerance = 3e-3;

TEST_F(CameraEffects, BloomIsItsTwin) {
    Portrait character = make_character(test::make_face({.targets = 0}));
    const Offscreen offscreen = make_offscreen(61, 46, Output::linear_hdr);
    const Picture off = radiance_of(test::draw(character, offscreen));
    ASSERT_TRUE(character.set("bloom.strength", "0.6"));
    ASSERT_TRUE(character.set("bloom.radius", "0.3"));
    for (const char* threshold : {"0", "0.2"}) {
        ASSERT_TRUE(character.set("bloom.threshold", threshold));
        const Picture on = radiance_of(test::draw(character, offscreen));
        const Picture twin = bloomed(off, 0.6, std::stod(threshold), bloom_levels(0.3, 61, 46));
        EXPECT_LE(worst_difference(on, twin), bloom_tolerance) << threshold;
        EXPECT_GT(worst_difference(on, off), 10 * bloom_tolerance);
    }
}

TEST_F(CameraEffects, BloomLeavesAConstantImageItsBits) {
    Portrait character = nothing();
    ASSERT_TRUE(character.set("bloom.strength", "0.5"));
    const Offscreen offscreen = make_offscreen(50, 33, Output::linear_hdr);
    ViewFrame view = test::framed_view(character, offscreen);
    view.background_linear = {0.7F, 3.1F, 512.0F, 1};
    const Image image = test::draw(character, offscreen, view);
    for (std::size_t i = 0; i < image.floats.size(); i += 4) {
        ASSERT_EQ(image.floats[i + 2], 512.0F);
        ASSERT_EQ(image.floats[i], image.floats[0]);
        ASSERT_NEAR(static_cast<double>(image.floats[i]), 0.7, 0.7 / 2048);
    }
}

TEST_F(CameraEffects, ExposureBringsAConstantImageToTheKey) {
    Portrait character = nothing();
    ASSERT_TRUE(character.set("exposure.mode", "automatic"));
    const Offscreen offscreen = make_offscreen(40, 30);
    for (const char* metering : {"frame", "centre"}) {
        ASSERT_TRUE(character.set("exposure.metering", metering));
        for (const float radiance : {0.05F, 0.2F, 5.0F}) {
            ViewFrame view = test::framed_view(character, offscreen);
            view.cut = true;
            view.background_linear = glm::vec4(glm::vec3(radiance), 1);
            const Image image = test::draw(character, offscreen, view);
            EXPECT_NEAR(image.bytes[0], display_byte(0.18 * static_cast<double>(radiance / (radiance + 1e-4F))), 1)
                << radiance;
        }
    }
    // No further from the view's own exposure than the range has it.
    ASSERT_TRUE(character.set("exposure.range_stops", "2"));
    ViewFrame view = test::framed_view(character, offscreen);
    view.cut = true;
    view.background_linear = glm::vec4(glm::vec3(0.01F), 1);
    EXPECT_NEAR(test::draw(character, offscreen, view).bytes[0], display_byte(0.04), 1);
}

TEST_F(CameraEffects, ExposureIsItsTwinAndAdaptsByTheTimeThatHasPassed) {
    Portrait character = make_character(test::make_face({.targets = 0})),
             meter = make_character(test::make_face({.targets = 0}));
    ASSERT_TRUE(character.set("exposure.mode", "automatic"));
    ASSERT_TRUE(character.set("exposure.metering", "centre"));
    ASSERT_TRUE(character.set("exposure.brighter_half_life", "0.25"));
    // As radiance is resolved, which the meter's frame shows.
    ASSERT_TRUE(character.set("multisampling.resolve", "average"));
    const Offscreen display = make_offscreen(47, 39), linear = make_offscreen(47, 39, Output::linear_hdr);
    Lighting bright, dark;
    bright.sky_radiance_linear = bright.ground_radiance_linear = glm::vec3(4);
    dark.sky_radiance_linear = dark.ground_radiance_linear = glm::vec3(0.25F);
    const auto target = [&](const Lighting& lighting) {
        ViewFrame view = test::framed_view(meter, linear);
        view.lighting = &lighting;
        const Picture picture = radiance_of(test::draw(meter, linear, view));
        return std::pair(picture, log2_exposure(log2_average_luminance(picture, Metering::centre), 0.18, 0, 6));
    };
    const auto expect_exposed = [&](const Image& image, const Picture& radiance, double log2_factor) {
        double worst = 0;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const double value = display_byte(radiance.at(x, y).y * std::exp2(log2_factor));
                worst = std::max(
                    worst,
                    std::abs(value - image.bytes[4 * (std::size_t{image.height - 1 - y} * image.width + x) + 1]));
            }
        }
        EXPECT_LE(worst, 1);
    };
    ViewFrame view = test::framed_view(character, display);
    view.lighting = &bright;
    const auto [bright_picture, bright_log2] = target(bright);
    const auto [dark_picture, dark_log2] = target(dark);
    expect_exposed(test::draw(character, display, view), bright_picture, bright_log2);
    view.lighting = &dark;
    view.time_seconds = 0.25;
    expect_exposed(test::draw(character, display, view), dark_picture, 0.5 * (bright_log2 + dark_log2));
    view.cut = true;
    expect_exposed(test::draw(character, display, view), dark_picture, dark_log2);
}

TEST_F(CameraEffects, WhatIsNoNumberIsNotMetered) {
    Portrait character = make_character(test::make_face({.targets = 0}));
    ASSERT_TRUE(character.set("exposure.mode", "automatic"));
    ASSERT_TRUE(character.set("scattering.method", "off"));
    const Offscreen display = make_offscreen(32, 32), linear = make_offscreen(32, 32, Output::linear_hdr);
    const auto view_of = [&](const Offscreen& of) {
        ViewFrame view = test::framed_view(character, of);
        view.check_finite = false;
        view.samples = 1;
        view.cut = true;
        view.background_linear = glm::vec4(glm::vec3(NAN), 1);
        return view;
    };
    const Picture radiance = radiance_of(test::draw(character, linear, view_of(linear)));
    std::size_t broken = 0;
    for (const glm::dvec3& c : radiance.values) broken += std::isfinite(c.x) ? 0U : 1U;
    ASSERT_GT(broken, 100U);
    ASSERT_LT(broken, 900U);
    test::draw(character, display, view_of(display));
    const FrameState& state = character.frame();
    float found = 0;
    glGetTextureImage(state.graph[*state.resources.log2_exposure].handle, 0, GL_RED, GL_FLOAT, sizeof(found), &found);
    EXPECT_NEAR(static_cast<double>(found),
                log2_exposure(log2_average_luminance(radiance, Metering::frame), 0.18, 0, 6), 1e-4);
}

TEST_F(CameraEffects, WhatIsNoNumberStaysWhereItIs) {
    Portrait character = make_character(test::make_face({.targets = 0}));
    const Offscreen offscreen = make_offscreen(32, 32), linear = make_offscreen(32, 32, Output::linear_hdr);
    const auto view_of = [&](const Offscreen& of) {
        ViewFrame view = test::framed_view(character, of);
        view.check_finite = false;
        view.samples = 1;
        return view;
    };
    ASSERT_TRUE(character.set("scattering.method", "off"));
    const Image clean = test::draw(character, offscreen, view_of(offscreen));
    for (const float broken : {NAN, INFINITY, 65504.0F}) {
        ViewFrame view = view_of(offscreen);
        view.background_linear = glm::vec4(glm::vec3(broken), 1);
        const Image alone = test::draw(character, offscreen, view);
        const std::size_t middle = 4 * (16 * 32 + 16);
        EXPECT_EQ(alone.bytes[middle], clean.bytes[middle]);
        ASSERT_TRUE(character.set("bloom.strength", "0.01"));
        ASSERT_TRUE(character.set("depth_of_field.f_number", "0.1"));
        ViewFrame linear_view = view_of(linear);
        linear_view.background_linear = view.background_linear;
        linear_view.camera = view.camera;
        for (const float texel : test::draw(character, linear, linear_view).floats) {
            ASSERT_TRUE(std::isfinite(texel));
        }
        EXPECT_TRUE(std::isfinite(test::draw(character, linear, linear_view).floats[middle]));
        ASSERT_TRUE(character.set("exposure.mode", "automatic"));
        ASSERT_TRUE(character.set("grain.strength", "0.1"));
        EXPECT_GT(test::draw(character, offscreen, view).bytes[middle], 0);
        ASSERT_TRUE(character.set("exposure.mode", "fixed"));
        ASSERT_TRUE(character.set("grain.strength", "0"));
        ASSERT_TRUE(character.set("bloom.strength", "0"));
        ASSERT_TRUE(character.set("depth_of_field.f_number", "0"));
    }
}

TEST_F(CameraEffects, GrainIsItsTwinAndTheSameForTheSameFrame) {
    Portrait character = make_character(test::make_face({.targets = 0}));
    const Offscreen offscreen = make_offscreen(48, 40);
    const Image off = test::draw(character, offscreen);
    ASSERT_TRUE(character.set("grain.strength", "0.1"));
    ASSERT_TRUE(character.set("grain.seed", "3"));
    for (const char* size : {"1", "2.5"}) {
        ASSERT_TRUE(character.set("grain.size", size));
        ViewFrame view = test::framed_view(character, offscreen);
        view.frame_number = 7;
        const Image on = test::draw(character, offscreen, view);
        EXPECT_EQ(test::draw(character, offscreen, view).bytes, on.bytes);
        double worst = 0, sum = 0;
        for (std::uint32_t y = 0; y < on.height; ++y) {
            for (std::uint32_t x = 0; x < on.width; ++x) {
                const double noise = film_grain_noise(x, on.height - 1 - y, 7, 3, std::stod(size));
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::size_t at = 4 * (std::size_t{y} * on.width + x) + c;
                    const double before = off.bytes[at] / 255.0;
                    const double value = before + film_grain_deviation(before, 0.1, std::stod(size)) * noise;
                    worst = std::max(worst, std::abs(255 * value - on.bytes[at]));
                    sum += on.bytes[at] - off.bytes[at];
                }
            }
        }
        EXPECT_LE(worst, 0.51);  // rounding to a byte, and single precision
        EXPECT_NEAR(sum / (on.width * on.height * 3), 0, 2);
        view.frame_number = 8;
        EXPECT_NE(test::draw(character, offscreen, view).bytes, on.bytes);
    }
}

// Two planes before a camera at the origin: a checkerboard at 1000 mm, and a strip of it at 600 mm.

constexpr std::uint32_t side = 96;
// The strip's edges cut through pixels, between their samples, and its right one ends a tile: what it spreads over
// belongs to the next.
constexpr float strip_half = 0.02888F, field_radians = 0.4F;

void add_square(Face& face, glm::vec2 low, glm::vec2 high, float z, std::int32_t material) {
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    const auto first_index = static_cast<std::uint32_t>(face.indices.size());
    for (const glm::vec2 p : {low, glm::vec2(high.x, low.y), high, glm::vec2(low.x, high.y)}) {
        face.positions.emplace_back(p, z);
        face.normals.emplace_back(0, 0, 1);
        face.tangents.emplace_back(1, 0, 0, 1);
        face.uv0.emplace_back(0);
        face.uv1.emplace_back(0);
    }
    face.indices.insert(face.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    test::add_primitive(face, first, first_index);
    face.primitives.back().material = material;
}

Face two_planes() {
    Face face;
    face.path = "test";
    for (const glm::vec3 color : {glm::vec3(0.2F, 0.1F, 0.4F), glm::vec3(0.9F, 1.6F, 0.3F), glm::vec3(3, 0.5F, 0.7F)}) {
        Material material;
        material.name = "eye";
        material.metallic = 0;
        material.base_color_linear = glm::vec4(0, 0, 0, 1);
        material.emissive_linear = color;
        face.materials.push_back(material);
    }
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            const glm::vec2 low(0.06F * static_cast<float>(column - 4), 0.06F * static_cast<float>(row - 4));
            add_square(face, low, low + 0.06F, -1, (row + column) % 2);
        }
    }
    add_square(face, {-strip_half, -1}, {strip_half, 1}, -0.6F, 2);
    face.meshes.push_back({"mesh", 0, static_cast<std::uint32_t>(face.primitives.size())});
    Node node;
    node.mesh = 0;
    face.nodes.push_back(node);
    return face;
}

bool on_strip(std::uint32_t x) {
    const double at = (2 * (x + 0.5) / side - 1) * std::tan(0.5 * static_cast<double>(field_radians)) * 0.6;
    return std::abs(at) < static_cast<double>(strip_half);
}

class DepthOfFieldFrames : public CameraEffects {
protected:
    DepthOfFieldFrames()
        : character_(make_character(two_planes())), offscreen_(make_offscreen(side, side, Output::linear_hdr)) {
        EXPECT_TRUE(character_.set("scattering.millimetres_a_unit", "1000"));
        EXPECT_TRUE(character_.set("depth_of_field.largest_radius", "0.1"));
        EXPECT_TRUE(character_.set("parts.eyes", "plain"));
    }
    Picture draw(const char* f_number, const char* focus_mm, std::uint32_t samples = 1) {
        EXPECT_TRUE(character_.set("depth_of_field.f_number", f_number));
        EXPECT_TRUE(character_.set("depth_of_field.focus_mm", focus_mm));
        ViewFrame view = offscreen_.view();
        view.samples = samples;
        view.check_finite = true;
        static const Lighting none;
        view.lighting = &none;
        view.camera = {glm::mat4(1), glm::perspective(field_radians, 1.0F, 0.1F, 10.0F)};
        return radiance_of(test::draw(character_, offscreen_, view));
    }

    Portrait character_;
    Offscreen offscreen_;
};

TEST_F(DepthOfFieldFrames, IsItsTwinWithEitherPlaneInFocus) {
    const Picture sharp = draw("0", "0");
    for (const double focus_mm : {1000.0, 600.0, 750.0, 480.0}) {
        const Picture blurred = draw("1.4", std::to_string(focus_mm).c_str());
        const double focal_length_mm = 12 / std::tan(0.5 * static_cast<double>(field_radians));
        const BlurRadius blur = blur_radius({1.4, focal_length_mm, focus_mm, 24}, side, 0.1 * side);
        Map<float> radius(side, side);
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x)
                radius.at(x, y) = static_cast<float>(blur.at(on_strip(x) ? 600 : 1000));
        }
        const auto tile = static_cast<std::uint32_t>(std::ceil(0.1 * side));
        const Picture twin = defocused(sharp, radius, blur_taps(49), tile);
        // The depth buffer's single precision moves a radius by 1e-4 of a pixel and so, at a rounding, one tap of 49.
        EXPECT_LE(worst_difference(blurred, twin), 3.0 / 49) << focus_mm;
        double mean = 0;
        for (std::size_t p = 0; p < twin.values.size(); ++p) mean += glm::length(blurred.values[p] - twin.values[p]);
        EXPECT_LE(mean / static_cast<double>(twin.values.size()), 2e-3) << focus_mm;
        EXPECT_GT(worst_difference(blurred, sharp), 0.2);
        // The plane in focus keeps its bits where nothing blurred stands in front of it.
        const bool strip_sharp = focus_mm == 600.0;
        for (std::uint32_t x = 0; x < side && (strip_sharp || focus_mm == 1000.0); ++x) {
            const bool far_from_strip = x < 12 || x >= side - 12;
            if (!(strip_sharp ? on_strip(x) : far_from_strip)) continue;
            EXPECT_EQ(blurred.at(x, 31), sharp.at(x, 31)) << x;
        }
    }
}

TEST_F(DepthOfFieldFrames, ASharpForegroundGivesNothingToABlurredBackground) {
    const Picture blurred = draw("1.4", "600");
    // Red of 3 is the strip's alone; the checkerboard has 0.9 at most.
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            if (on_strip(x)) continue;
            EXPECT_LE(blurred.at(x, y).x, 0.9 * 1.001);
        }
    }
    // With four samples a pixel, those of the edge have a share of the strip, as they have without depth of field.
    const Picture edges = draw("0", "0", 4), with = draw("1.4", "600", 4);
    for (std::uint32_t x = 0; x < side; ++x) {
        if (edges.at(x, 40).x > 0.9 * 1.001) continue;
        EXPECT_LE(with.at(x, 40).x, 0.9 * 1.001) << x;
    }
}

TEST_F(DepthOfFieldFrames, HardLensesStayFinite) {
    for (const char* f_number : {"0.001", "1", "1000"}) {
        for (const char* focus_mm : {"0.001", "50", "1000000000"}) {
            for (const glm::dvec3& c : draw(f_number, focus_mm).values) ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
        }
    }
}

}  // namespace
}  // namespace blush
