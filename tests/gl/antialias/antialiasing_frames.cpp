// Antialiasing over whole frames: where samples stand, what moves, what the last frame leaves.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "rig/deform/deform_exact.h"
#include "runtime/antialias/last_frame.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"

namespace blush {
namespace {

using test::draw;
using test::framed_view;
using test::make_face;

/// IEC 61966-2-1 in double precision.
double linear_from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double srgb_from_linear(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// Step of half floats, relative: a driver may round towards zero (llvmpipe does).
constexpr double half_float_step = 1.0 / 1024;

class AntialiasingFrames : public test::GlTest {
protected:
    static void set(Portrait& character, const std::string& setting, const std::string& choice) {
        const Status done = character.set(setting, choice);
        ASSERT_TRUE(done) << done.error().message;
    }
    Portrait character_in(const std::string& mode, const Face& face = make_face({.side = 14, .targets = 2})) const {
        Portrait character = make_character(face);
        set(character, "antialiasing.mode", mode);
        return character;
    }
    static const EffectReport& effect(const FrameReport& report, std::string_view name) {
        return *std::ranges::find(report.effects, name, &EffectReport::effect);
    }
    static std::vector<float> read_texture(GLuint name, std::uint32_t side, std::size_t channels) {
        std::vector<float> values(std::size_t{side} * side * channels);
        glGetTextureImage(name, 0, channels == 1 ? GL_RED : GL_RGBA, GL_FLOAT,
                          static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
        return values;
    }
    static std::vector<float> read_depth(GLuint name, std::uint32_t side) {
        std::vector<float> values(std::size_t{side} * side);
        glGetTextureImage(name, 0, GL_DEPTH_COMPONENT, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                          values.data());
        return values;
    }
    /// Of 255, beyond one step of 8 bits: means of rounded pictures round otherwise than one picture does.
    static double difference(const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.bytes.size(); ++i) {
            sum += std::max(0, std::abs(int{a.bytes[i]} - int{b.bytes[i]}) - 1);
        }
        return sum / static_cast<double>(a.bytes.size());
    }
};

// --- where samples stand -------------------------------------------------------------------------------------------

Sampling sampling_of(const char* mode, const char* factor = "3") {
    EffectSettings settings;
    EXPECT_TRUE(settings.set("antialiasing.mode", mode));
    EXPECT_TRUE(settings.set("supersampling.factor", factor));
    return find_sampling(settings, ViewFrame{}, 4, true);
}

TEST(Sampling, PlacesOfEveryModeSumToZero) {
    for (const std::string_view mode : antialiasing_modes) {
        const Sampling sampling = sampling_of(std::string(mode).c_str());
        glm::dvec2 sum(0);
        for (std::uint32_t phase = 0; phase < 2; ++phase) {
            for (std::uint32_t picture = 0; picture < sampling.pictures; ++picture) {
                const glm::vec2 offset = sampling.sample_offset_pixels(picture, phase);
                EXPECT_LE(std::abs(offset.x), 0.5F) << mode;
                EXPECT_LE(std::abs(offset.y), 0.5F) << mode;
                sum += glm::dvec2(offset);
            }
        }
        EXPECT_NEAR(glm::length(sum), 0, 1e-6) << mode;
    }
}

TEST(Sampling, FourPlacesOf4xAreTheRotatedGrid) {
    const Sampling sampling = sampling_of("smaa_4x");
    std::vector<float> columns, rows;
    for (const std::uint32_t phase : {0U, 1U}) {
        for (const std::uint32_t picture : {0U, 1U}) {
            const glm::vec2 offset = sampling.sample_offset_pixels(picture, phase);
            columns.push_back(offset.x);
            rows.push_back(offset.y);
        }
    }
    std::ranges::sort(columns);
    std::ranges::sort(rows);
    const std::vector<float> eighths = {-0.375F, -0.125F, 0.125F, 0.375F};  // every column and every row once
    EXPECT_EQ(columns, eighths);
    EXPECT_EQ(rows, eighths);
}

TEST(Sampling, CountsFollowModeViewAndDevice) {
    EXPECT_EQ(sampling_of("view").samples, 4U);
    EXPECT_EQ(sampling_of("msaa2").samples, 2U);
    EXPECT_EQ(sampling_of("none").samples, 1U);
    EXPECT_EQ(sampling_of("supersampled", "8").pictures, 64U);
    EffectSettings settings;
    ViewFrame view;
    view.samples = 0;
    EXPECT_EQ(find_sampling(settings, view, 4, true).samples, 1U);
    view.samples = 64;
    EXPECT_EQ(find_sampling(settings, view, 4, true).samples, 4U);
    ASSERT_TRUE(settings.set("antialiasing.mode", "smaa_4x"));
    EXPECT_EQ(find_sampling(settings, view, 4, false), Sampling{}) << "what has nothing to draw needs one sample";
    ASSERT_TRUE(settings.set("velocities.source", "none"));
    EXPECT_FALSE(find_sampling(settings, view, 4, true).temporal);
}

TEST(Sampling, AJitteredCameraSeesThePointAtItsSampleInTheMiddle) {
    const Camera camera = OrbitCamera{}.camera(1.5F);
    const glm::vec2 offset(0.25F, -0.375F), size(60, 40);
    const Camera moved = jittered(camera, offset, 60, 40);
    for (const glm::vec3 point : {glm::vec3(0), glm::vec3(0.1F, -0.2F, 0.3F), glm::vec3(-0.1F, 0.05F, -0.4F)}) {
        const auto pixel = [&](const Camera& of) {
            const glm::vec4 clip = of.clip_from_view * glm::mat4(of.view_from_world) * glm::vec4(point, 1);
            return (glm::vec2(clip) / clip.w * 0.5F + 0.5F) * size;
        };
        EXPECT_NEAR(glm::length(pixel(moved) - (pixel(camera) - offset)), 0, 1e-4);
    }
    EXPECT_EQ(jittered(camera, glm::vec2(0), 60, 40), camera);
}

// --- multisampling and supersampling -------------------------------------------------------------------------------

TEST_F(AntialiasingFrames, TheHdrResolveWeighsBrightSamplesLess) {
    // A face that glows, before darkness: a pixel of its outline has k of n bright samples.
    constexpr double bright = 40;
    Face face = make_face({.side = 14, .targets = 0});
    face.materials[0].base_color_linear = {0, 0, 0, 1};
    face.materials[0].metallic = 1;
    face.materials[0].roughness = 1;
    face.materials[0].emissive_linear = glm::vec3(static_cast<float>(bright));
    Portrait character = character_in("msaa4", face);
    set(character, "multisampling.resolve", "hdr");
    const Offscreen offscreen = make_offscreen(64, 64, Output::linear_hdr);
    ViewFrame view = framed_view(character, offscreen);
    view.background_linear = {0.5F, 0.5F, 0.5F, 1};
    view.exposure = 0.5F;
    const Image image = draw(character, offscreen, view);

    GLint samples = 4;
    std::vector<double> expected;
    for (GLint k = 0; k <= samples; ++k) {
        const double share = static_cast<double>(k) / samples;
        const double w_bright = 1 / (1 + 0.5 * bright), w_dark = 1 / (1 + 0.5 * 0.5);
        expected.push_back((share * w_bright * bright + (1 - share) * w_dark * 0.5) /
                           (share * w_bright + (1 - share) * w_dark));
    }
    std::vector<int> found(expected.size(), 0);
    for (std::size_t p = 0; p < image.floats.size(); p += 4) {
        const auto value = static_cast<double>(image.floats[p]);
        double nearest = 1e9;
        for (std::size_t k = 0; k < expected.size(); ++k) {
            const double relative = std::abs(value - expected[k]) / expected[k];
            // 0.2 %: half floats, and the little that lights add to a black surface.
            if (relative < 0.002) ++found[k];
            nearest = std::min(nearest, relative);
        }
        ASSERT_LT(nearest, 0.002) << value << " is the resolve of no number of samples";
    }
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_GT(found[k], 0) << k << " of 4 samples never seen";
}

TEST_F(AntialiasingFrames, TheResolveIsWeighedForADisplayAndPlainForRadiance) {
    const Face face = make_face({.side = 14, .targets = 0});
    for (const auto& [output, expected] : {std::pair(Output::display_srgb, "hdr"), {Output::linear_hdr, "average"}}) {
        const Offscreen offscreen = make_offscreen(40, 40, output);
        const auto drawn = [&](const char* resolve) {
            Portrait character = character_in("msaa4", face);
            set(character, "multisampling.resolve", resolve);
            return draw(character, offscreen);
        };
        const Image automatic = drawn("auto"), average = drawn("average"), hdr = drawn("hdr");
        const Image& wanted = std::string_view(expected) == "hdr" ? hdr : average;
        EXPECT_EQ(automatic.bytes, wanted.bytes);
        EXPECT_EQ(automatic.floats, wanted.floats);
        EXPECT_TRUE(average.bytes != hdr.bytes || average.floats != hdr.floats);
    }
}

TEST_F(AntialiasingFrames, SupersamplingIsTheMeanOfItsPicturesInLinearLight) {
    const Face face = make_face({.side = 14, .targets = 0});
    Portrait whole = character_in("supersampled", face), single = character_in("none", face);
    set(whole, "supersampling.factor", "3");
    const Offscreen offscreen = make_offscreen(40, 40);
    const ViewFrame view = framed_view(whole, offscreen);
    const Image image = draw(whole, offscreen, view);
    const Sampling sampling = sampling_of("supersampled", "3");
    std::vector<double> mean(image.bytes.size(), 0);
    for (std::uint32_t picture = 0; picture < 9; ++picture) {
        ViewFrame moved = view;
        moved.camera = jittered(view.camera, sampling.sample_offset_pixels(picture, 0), 40, 40);
        const Image one = draw(single, offscreen, moved);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += linear_from_srgb(one.bytes[i] / 255.0) / 9;
    }
    double worst = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        if (i % 4 != 3) worst = std::max(worst, std::abs(255 * srgb_from_linear(mean[i]) - image.bytes[i]));
    }
    EXPECT_LE(worst, 0.6) << "half a step of 8 bits, and a texture unit's rounding of sRGB";
}

// --- convergence, and what is left out -------------------------------------------------------------------------------

TEST_F(AntialiasingFrames, AStillFaceConvergesToOnePicture) {
    const Face face = make_face({.side = 14, .targets = 2});
    const Offscreen offscreen = make_offscreen(64, 64);
    Portrait reference = character_in("supersampled", face), filter = character_in("smaa_1x", face);
    set(reference, "supersampling.factor", "8");
    const ViewFrame view = framed_view(reference, offscreen);
    const Image truth = draw(reference, offscreen, view), alone = draw(filter, offscreen, view);
    for (const char* mode : {"smaa_t2x", "smaa_4x"}) {
        SCOPED_TRACE(mode);
        Portrait character = character_in(mode, face);
        const Image first = draw(character, offscreen, view), second = draw(character, offscreen, view);
        EXPECT_NE(first.bytes, second.bytes);
        for (int frame = 2; frame < 6; ++frame) EXPECT_EQ(draw(character, offscreen, view).bytes, second.bytes);
        EXPECT_LT(difference(second, truth), 0.9 * difference(alone, truth));
        // The face moves and stops: the same picture again.
        test::set_weights(character, {1, 0});
        draw(character, offscreen, view);
        test::set_weights(character, {0, 0});
        draw(character, offscreen, view);
        draw(character, offscreen, view);
        EXPECT_EQ(draw(character, offscreen, view).bytes, second.bytes);
    }
}

TEST_F(AntialiasingFrames, ForcingChangesNoByteInAnyModeStillOrMoving) {
    Face face = make_face({.side = 14, .targets = 2});
    // Not skin: at this size scattering is left out within a bound, and forcing it changes bytes.
    face.materials.resize(std::max<std::size_t>(face.materials.size(), 1));
    for (Material& material : face.materials) material.name = "teeth";
    for (Primitive& primitive : face.primitives) primitive.material = 0;
    for (const Output output : {Output::display_srgb, Output::linear_hdr}) {
        const Offscreen offscreen = make_offscreen(24, 24, output);
        for (const std::string_view mode : antialiasing_modes) {
            SCOPED_TRACE(mode);
            Portrait plain = character_in(std::string(mode), face), forced = character_in(std::string(mode), face);
            if (mode == "supersampled") {
                set(plain, "supersampling.factor", "2");
                set(forced, "supersampling.factor", "2");
            }
            ViewFrame view = framed_view(plain, offscreen);
            for (const float weight : {0.0F, 0.0F, 1.0F, 1.0F}) {
                test::set_weights(plain, {weight, 0});
                test::set_weights(forced, {weight, 0});
                view.force_effects = false;
                const Image without = draw(plain, offscreen, view);
                view.force_effects = true;
                const Image with = draw(forced, offscreen, view);
                EXPECT_EQ(without.bytes, with.bytes);
                EXPECT_EQ(without.floats, with.floats);
            }
        }
    }
}

TEST_F(AntialiasingFrames, SaysWhatIsLeftOutAndWhy) {
    Portrait character = character_in("smaa_t2x");
    const Offscreen offscreen = make_offscreen(24, 24);
    ViewFrame view = framed_view(character, offscreen);
    FrameReport report = character.draw(view);
    EXPECT_EQ(effect(report, "reprojection").reason,
              "there is no last frame of this size and mode: it is the first, or a cut");
    EXPECT_TRUE(report.incomplete);
    report = character.draw(view);
    EXPECT_FALSE(report.incomplete);
    EXPECT_TRUE(effect(report, "reprojection").on);
    EXPECT_FALSE(effect(report, "velocities").on);
    EXPECT_EQ(effect(report, "velocities").reason, "nothing moves: every velocity is zero");
    test::set_weights(character, {1, 0});
    EXPECT_TRUE(effect(character.draw(view), "velocities").on);
    view.cut = true;
    EXPECT_FALSE(effect(character.draw(view), "reprojection").on);
    view.cut = false;
    EXPECT_TRUE(effect(character.draw(view), "reprojection").on);
    view.width = 20;
    EXPECT_FALSE(effect(character.draw(view), "reprojection").on) << "another size is a cut";

    set(character, "velocities.source", "none");
    character.draw(view);
    report = character.draw(view);
    EXPECT_EQ(effect(report, "reprojection").reason,
              "there are no velocities (velocities.source=none): every frame stands alone");
    EXPECT_FALSE(report.incomplete);

    set(character, "antialiasing.mode", "none");
    report = character.draw(view);
    EXPECT_EQ(effect(report, "antialiasing").reason, "antialiasing.mode asks for no filter");
    EXPECT_EQ(effect(report, "multisampling").reason, "one sample a pixel is asked for");
    EXPECT_FALSE(character.frame().own<LastFrame>().images[0].color) << "what is off keeps nothing";
}

TEST_F(AntialiasingFrames, AFaceThatIsNotThereNeedsOneSampleInEveryMode) {
    Face face = make_face({.side = 14, .targets = 1});
    for (Primitive& primitive : face.primitives) primitive.index_count = 0;
    const Offscreen offscreen = make_offscreen(8, 8);
    std::vector<std::uint8_t> background;
    for (const std::string_view mode : antialiasing_modes) {
        Portrait character = character_in(std::string(mode), face);
        const ViewFrame view = framed_view(character, offscreen);
        const Image image = draw(character, offscreen, view);
        if (background.empty()) background = image.bytes;
        EXPECT_EQ(image.bytes, background) << mode;
        EXPECT_EQ(character.frame().sampling, Sampling{}) << mode;
    }
}

TEST_F(AntialiasingFrames, WhatCannotBeOnTheScreenNeedsOneSampleAndIsExact) {
    const Face face = make_face({.side = 14, .targets = 1});
    const Offscreen offscreen = make_offscreen(16, 16);
    Portrait character = character_in("smaa_4x", face), forced = character_in("smaa_4x", face);
    ViewFrame view = framed_view(character, offscreen);
    std::size_t seen = 0, away = 0;
    // The dome's radius is 1, and half of the picture's width is a little more.
    for (const float x : {0.0F, 1.0F, 1.9F, 2.0F, 2.1F, 2.2F, 2.3F, 2.4F, 2.6F, 2.8F, 3.0F, 16.0F}) {
        for (Portrait* drawn : {&character, &forced}) drawn->pose().nodes[0].translation = {x, 0, 0};
        view.cut = true;
        view.force_effects = true;
        const Image truth = draw(forced, offscreen, view);
        view.force_effects = false;
        const Image image = draw(character, offscreen, view);
        if (character.frame().facts.on_screen) {
            ++seen;
            continue;
        }
        ++away;
        EXPECT_EQ(character.frame().sampling, Sampling{});
        EXPECT_EQ(forced.frame().sampling.pictures, 2U);
        EXPECT_EQ(effect(character.report(), "antialiasing").reason,
                  "no part of the face can be on the screen: the picture has no edges");
        EXPECT_EQ(image.bytes, truth.bytes) << x;
    }
    EXPECT_GT(seen, 2U);
    EXPECT_GT(away, 2U);
}

TEST_F(AntialiasingFrames, WithoutVelocitiesEveryFrameIsThatOfTheFilterAlone) {
    const Face face = make_face({.side = 14, .targets = 2});
    Portrait temporal = character_in("smaa_t2x", face), alone = character_in("smaa_1x", face);
    set(temporal, "velocities.source", "none");
    const Offscreen offscreen = make_offscreen(40, 40);
    const ViewFrame view = framed_view(alone, offscreen);
    for (const float weight : {0.0F, 0.5F, 1.0F}) {
        test::set_weights(temporal, {weight, 0});
        test::set_weights(alone, {weight, 0});
        EXPECT_EQ(draw(temporal, offscreen, view).bytes, draw(alone, offscreen, view).bytes);
    }
}

TEST_F(AntialiasingFrames, ACutShowsNothingOfTheFrameBefore) {
    const Face face = make_face({.side = 14, .targets = 2});
    Portrait character = character_in("smaa_4x", face), fresh = character_in("smaa_4x", face);
    const Offscreen offscreen = make_offscreen(40, 40);
    ViewFrame view = framed_view(character, offscreen);
    test::set_weights(character, {1, 1});
    draw(character, offscreen, view);
    draw(character, offscreen, view);
    test::set_weights(character, {0, 0});
    view.cut = true;
    const Image cut = draw(character, offscreen, view);
    view.cut = false;
    EXPECT_EQ(cut.bytes, draw(fresh, offscreen, view).bytes);
    EXPECT_EQ(draw(character, offscreen, view).bytes, draw(fresh, offscreen, view).bytes);
}

// --- velocities ------------------------------------------------------------------------------------------------------

/// The surface of a face in double precision, as the camera sees it.
struct ExactView {
    std::vector<glm::dvec4> clip;
    ExactView(const Face& face, const std::vector<float>& weights, const glm::mat4& world_from_mesh,
              const Camera& camera) {
        const glm::dmat4 clip_from_mesh =
            glm::dmat4(camera.clip_from_view) * glm::dmat4(camera.view_from_world) * glm::dmat4(world_from_mesh);
        for (const glm::dvec3& position : deform_exact(face, weights).positions) {
            clip.push_back(clip_from_mesh * glm::dvec4(position, 1));
        }
    }
    glm::dvec2 pixel(std::uint32_t vertex, double side) const {
        return (glm::dvec2(clip[vertex]) / clip[vertex].w * 0.5 + 0.5) * side;
    }
};

/// Velocity at every pixel that a triangle covers, in widths and heights of the picture; NaN elsewhere.
std::vector<glm::dvec2> exact_velocities(const Face& face, const ExactView& sampled, const ExactView& now,
                                         const ExactView& last, int side) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<glm::dvec2> velocities(static_cast<std::size_t>(side * side), glm::dvec2(none));
    std::vector<double> depths(velocities.size(), 2);
    for (std::size_t t = 0; t + 2 < face.indices.size(); t += 3) {
        const std::uint32_t* v = &face.indices[t];
        const glm::dvec2 a = sampled.pixel(v[0], side), b = sampled.pixel(v[1], side), c = sampled.pixel(v[2], side);
        const auto cross = [](glm::dvec2 p, glm::dvec2 q) { return p.x * q.y - p.y * q.x; };
        const double area = cross(b - a, c - a);
        if (area <= 0) continue;
        const auto lowest = [](double x, double y, double z) { return static_cast<int>(std::min({x, y, z})); };
        const auto highest = [](double x, double y, double z) { return static_cast<int>(std::max({x, y, z})); };
        for (int y = std::max(0, lowest(a.y, b.y, c.y)); y <= std::min(side - 1, highest(a.y, b.y, c.y)); ++y) {
            for (int x = std::max(0, lowest(a.x, b.x, c.x)); x <= std::min(side - 1, highest(a.x, b.x, c.x)); ++x) {
                const glm::dvec2 p(x + 0.5, y + 0.5);
                const glm::dvec3 share(cross(b - p, c - p) / area, cross(c - p, a - p) / area,
                                       cross(a - p, b - p) / area);
                if (share.x < 0 || share.y < 0 || share.z < 0) continue;
                double depth = 0;
                glm::dvec4 clip(0), last_clip(0);
                for (glm::length_t k = 0; k < 3; ++k) {
                    const double w = sampled.clip[v[k]].w;
                    depth += share[k] * sampled.clip[v[k]].z / w;
                    clip += share[k] / w * now.clip[v[k]];
                    last_clip += share[k] / w * last.clip[v[k]];
                }
                const auto at = static_cast<std::size_t>(y * side + x);
                if (depth >= depths[at]) continue;
                depths[at] = depth;
                velocities[at] = 0.5 * (glm::dvec2(clip) / clip.w - glm::dvec2(last_clip) / last_clip.w);
            }
        }
    }
    return velocities;
}

/// What a moving face and camera look like in two frames after each other.
struct Motion {
    std::vector<float> weights;
    float camera_yaw_radians = 0;
    glm::vec3 translation{0};
};

class Velocities : public AntialiasingFrames {
protected:
    static constexpr std::uint32_t side = 56;

    ViewFrame stand(Portrait& character, const Offscreen& offscreen, const Motion& motion) const {
        test::set_weights(character, motion.weights);
        character.pose().nodes[0].translation = motion.translation;
        ViewFrame view = framed_view(character, offscreen);
        OrbitCamera camera = character.framing(1);
        camera.yaw_radians = motion.camera_yaw_radians;
        view.camera = camera.camera(1);
        return view;
    }
    /// Of the last frame drawn. Transient textures keep what was in them until a later frame.
    static std::vector<float> drawn_velocities(Portrait& character) {
        FrameState& state = character.frame();
        return read_texture(state.graph[state.resources.velocities].handle, side, 4);
    }
};

TEST_F(Velocities, AreTheDifferenceOfTheTwoSurfacesProjectedByTheCpu) {
    const Face face = make_face({.side = 14, .targets = 2});
    const Offscreen offscreen = make_offscreen(side, side);
    const std::vector<std::pair<Motion, Motion>> motions = {
        {{{0, 0}}, {{1, -0.5F}}},
        {{{0.2F, 0}, 0.1F}, {{0.2F, 0}, 0.25F}},
        {{{1, 1}, 0, {0, 0, 0}}, {{1, 1}, 0, {0.1F, -0.05F, 0.2F}}},
        {{{1, 0}, -0.2F, {0, 0.1F, 0}}, {{0, 1}, 0.1F, {0.1F, 0, 0}}},
    };
    for (std::size_t m = 0; m < motions.size(); ++m) {
        SCOPED_TRACE("motion " + std::to_string(m));
        Portrait character = character_in("smaa_t2x", face);
        const auto& [before, after] = motions[m];
        const ViewFrame last_view = stand(character, offscreen, before);
        draw(character, offscreen, last_view);
        const ViewFrame view = stand(character, offscreen, after);
        draw(character, offscreen, view);
        ASSERT_TRUE(effect(character.report(), "velocities").on);
        const std::vector<float> drawn = drawn_velocities(character);

        const auto world_from_mesh = [](const Motion& motion) {
            glm::mat4 matrix(1);
            matrix[3] = glm::vec4(motion.translation, 1);
            return matrix;
        };
        const Sampling sampling = sampling_of("smaa_t2x");
        const Camera sampled = jittered(view.camera, sampling.sample_offset_pixels(0, 1), side, side);
        const std::vector<glm::dvec2> exact =
            exact_velocities(face, ExactView(face, after.weights, world_from_mesh(after), sampled),
                             ExactView(face, after.weights, world_from_mesh(after), view.camera),
                             ExactView(face, before.weights, world_from_mesh(before), last_view.camera), side);
        std::size_t compared = 0, covered = 0, still = 0;
        double worst = 0, fastest = 0;
        for (std::size_t p = 0; p < exact.size(); ++p) {
            const glm::dvec2 velocity(static_cast<double>(drawn[4 * p + 1]), static_cast<double>(drawn[4 * p + 2]));
            if (std::isnan(exact[p].x)) {
                still += velocity == glm::dvec2(0) ? 0U : 1U;  // a pixel of the outline that the CPU sees as outside
                continue;
            }
            ++covered;
            const double speed = glm::length(exact[p]);
            fastest = std::max(fastest, speed);
            // Float projections differ by about 1e-6 of the screen; half floats round the result. Behind an outline
            // pixel that the CPU places otherwise is another part of the face.
            const double tolerance = 2e-6 + half_float_step * std::max(std::abs(velocity.x), std::abs(velocity.y));
            const double error = std::max(std::abs(velocity.x - exact[p].x), std::abs(velocity.y - exact[p].y));
            if (error > tolerance) continue;
            ++compared;
            worst = std::max(worst, error);
            EXPECT_NEAR(static_cast<double>(drawn[4 * p]), speed, 4e-6 + half_float_step * 2 * speed);
        }
        EXPECT_GT(covered, 800U);
        EXPECT_GE(compared + 4, covered) << "pixels beyond the tolerance";
        EXPECT_LE(still, 4U);
        EXPECT_GT(fastest, 0.005) << "nothing moved that could be wrong";
    }
}

TEST_F(Velocities, AJointedFaceMovesWithItsJoints) {
    Portrait character = character_in("smaa_t2x", make_face({.side = 14, .targets = 1, .joints = true}));
    const Offscreen offscreen = make_offscreen(side, side);
    const ViewFrame view = framed_view(character, offscreen);
    draw(character, offscreen, view);
    character.pose().nodes[1].rotation = rotation_of(glm::angleAxis(0.1F, glm::vec3(0, 0, 1)));
    draw(character, offscreen, view);
    const std::vector<float> drawn = drawn_velocities(character);
    float left = 0, right = 0;
    for (std::size_t p = 0; p < drawn.size(); p += 4) {
        float& sum = (p / 4) % side < side / 2 ? left : right;
        sum += drawn[p];
    }
    EXPECT_GT(right, 1.3F * left) << "the turned joint is on the picture's right";
    EXPECT_GT(left + right, 1.0F);
}

// --- reprojection ----------------------------------------------------------------------------------------------------

class Reprojection : public Velocities {
protected:
    /// What `rejection=surface` asks of a pixel: whether everything around its place in the last frame is what this
    /// frame has around it, moving alike. As shaders/antialias/reproject.frag, in double precision.
    struct Surfaces {
        const std::vector<float>&velocities, &last_depth;

        bool seen_alike(int x, int y, double last_x, double last_y) const {
            const auto cell = [](int px, int py) {
                return static_cast<std::size_t>(std::clamp(py, 0, int{side} - 1)) * side +
                       static_cast<std::size_t>(std::clamp(px, 0, int{side} - 1));
            };
            const auto velocity = [&](std::size_t p) {
                return glm::dvec2(velocities[4 * p + 1], velocities[4 * p + 2]) * double{side};
            };
            const glm::dvec2 own = velocity(cell(x, y));
            double lowest = 2, highest = -1;
            for (int i = 0; i < 9; ++i) {
                const std::size_t p = cell(x + i % 3 - 1, y + i / 3 - 1);
                const glm::dvec2 apart = glm::abs(velocity(p) - own);
                if (std::max(apart.x, apart.y) > 0.05 + 0.02 * glm::length(own)) continue;
                lowest = std::min(lowest, static_cast<double>(velocities[4 * p + 3]));
                highest = std::max(highest, static_cast<double>(velocities[4 * p + 3]));
            }
            const double tolerance = highest - lowest + 0.002 * highest + 1e-6;
            for (int i = 0; i < 9; ++i) {
                const std::size_t p = cell(static_cast<int>(last_x) + i % 3 - 1, static_cast<int>(last_y) + i / 3 - 1);
                const double before_far = 1 - static_cast<double>(last_depth[p]);
                if (before_far < lowest - tolerance || before_far > highest + tolerance) return false;
            }
            return true;
        }
    };
};

/// Equations 10.6 and 10.7, and the rejection, in double precision, on what the frame itself kept.
TEST_F(Reprojection, EqualsTheFormulaWithinOneOf255) {
    const Face face = make_face({.side = 14, .targets = 2});
    const Offscreen offscreen = make_offscreen(side, side);
    for (const char* mode : {"smaa_t2x", "smaa_4x"}) {
        SCOPED_TRACE(mode);
        Portrait character = character_in(mode, face);
        draw(character, offscreen, stand(character, offscreen, {{0, 0}, 0}));
        draw(character, offscreen, stand(character, offscreen, {{0.1F, 0.1F}, 0.002F}));
        const Image image = draw(character, offscreen, stand(character, offscreen, {{0.2F, 0.05F}, 0.005F}));
        const LastFrame& last = character.frame().own<LastFrame>();
        const KeptImage& now = last.images[last.phase];
        const KeptImage& before = last.images[1 - last.phase];
        ASSERT_TRUE(now.has_speeds && before.has_speeds);
        const std::vector<float> velocities = drawn_velocities(character),
                                 color = read_texture(now.color.name(), side, 4),
                                 last_color = read_texture(before.color.name(), side, 4),
                                 speeds = read_texture(now.speeds.name(), side, 1),
                                 last_speeds = read_texture(before.speeds.name(), side, 1),
                                 last_depth = read_depth(before.depth.name(), side);
        const Surfaces surfaces{velocities, last_depth};
        double worst = 0, most_weight = 0, least_weight = 1;
        std::size_t rejected = 0;
        for (int y = 0; y < int{side}; ++y) {
            for (int x = 0; x < int{side}; ++x) {
                const auto p = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
                const double px = x + 0.5 - static_cast<double>(velocities[4 * p + 1]) * side,
                             py = y + 0.5 - static_cast<double>(velocities[4 * p + 2]) * side;
                const bool on_screen = px >= 0 && py >= 0 && px <= side && py <= side;
                // Bilinear; `value(pixel)` of the four texels around.
                const auto sampled = [&](auto value) {
                    const double left = std::floor(px - 0.5), low = std::floor(py - 0.5);
                    double sum = 0;
                    for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                        const int tx = std::clamp(static_cast<int>(left) + dx, 0, int{side} - 1),
                                  ty = std::clamp(static_cast<int>(low) + dy, 0, int{side} - 1);
                        const double sx = px - 0.5 - left, sy = py - 0.5 - low;
                        sum += (dx == 1 ? sx : 1 - sx) * (dy == 1 ? sy : 1 - sy) *
                               value(static_cast<std::size_t>(ty) * side + static_cast<std::size_t>(tx));
                    }
                    return sum;
                };
                const double last_speed = sampled([&](std::size_t q) { return static_cast<double>(last_speeds[q]); });
                const double apart = std::abs(static_cast<double>(speeds[p]) - last_speed);
                const bool seen = on_screen && surfaces.seen_alike(x, y, px, py);
                const double weight = seen ? 0.5 * std::max(0.0, 1 - 30 * std::sqrt(apart)) : 0;
                rejected += seen ? 0U : 1U;
                most_weight = std::max(most_weight, weight);
                least_weight = std::min(least_weight, weight);
                for (std::size_t c = 0; c < 3; ++c) {
                    const double mixed = (1 - weight) * linear_from_srgb(static_cast<double>(color[4 * p + c])) +
                                         weight * sampled([&](std::size_t q) {
                                             return linear_from_srgb(static_cast<double>(last_color[4 * q + c]));
                                         });
                    const std::size_t from_the_top =
                        (side - 1 - static_cast<std::size_t>(y)) * side + static_cast<std::size_t>(x);
                    worst =
                        std::max(worst, std::abs(255 * srgb_from_linear(mixed) - image.bytes[4 * from_the_top + c]));
                }
            }
        }
        EXPECT_LE(worst, 1.0);
        EXPECT_GT(most_weight, 0.45);
        EXPECT_LT(least_weight, 0.05);
        EXPECT_GT(rejected, 20U);
        EXPECT_LT(rejected, side * side / 4) << "a face that moves as one is rejected at its outline alone";
    }
}

/// A face before a dark wall is moved to the side; where it was, the wall must show, and not a ghost of the face.
class Ghosts : public Reprojection {
protected:
    struct Way {
        const char* mode;
        const char* falloff;
        const char* rejection;
        bool from_rest;  ///< the last frame was still; else this is the third frame of one motion
    };
    /// Share of the ghost's energy that is left: over pixels that are all wall, squares of what is shown beyond it to
    /// squares of what the last frame has beyond it.
    double left_of_ghost(const Way& way, float pixels_a_frame) {
        Portrait character = character_in(way.mode, face_);
        set(character, "reprojection.falloff", way.falloff);
        set(character, "reprojection.rejection", way.rejection);
        // The dome is two units wide and fills most of the picture.
        const float step = pixels_a_frame * 2.0F / side;
        for (const float x : {0.0F, way.from_rest ? 0.0F : step, way.from_rest ? step : 2 * step}) {
            draw(character, offscreen_, stand(character, offscreen_, {{0}, 0, {x, 0, 0}}));
        }
        const Image image = offscreen_.read();
        const LastFrame& last = character.frame().own<LastFrame>();
        const std::vector<float> alone = read_texture(last.images[last.phase].color.name(), side, 4),
                                 before = read_texture(last.images[1 - last.phase].color.name(), side, 4);
        double ghost = 0, left = 0;
        for (std::size_t p = 0; p < alone.size() / 4; ++p) {
            const std::size_t y = p / side, x = p % side;
            const bool wall = std::equal(&alone[4 * p], &alone[4 * p] + 3, alone.begin());
            if (!wall) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const double shown = image.bytes[4 * ((side - 1 - y) * side + x) + c] / 255.0,
                             own = static_cast<double>(alone[4 * p + c]),
                             other = static_cast<double>(before[4 * p + c]);
                ghost += (other - own) * (other - own);
                left += (shown - own) * (shown - own);
            }
        }
        EXPECT_GT(ghost, 0.005) << "nothing was uncovered";
        return left / ghost;
    }

    Face face_ = make_face({.side = 14, .targets = 1});
    Offscreen offscreen_ = make_offscreen(side, side);
};

/// K = 30 of this picture of 56 pixels is K = 5 of one of 1920: with K = 0 nothing hangs on the picture's size.
TEST_F(Ghosts, AreRejectedAtEverySpeedWithOrWithoutTheWeight) {
    for (const float pixels_a_frame : {0.1F, 0.25F, 0.5F, 1.0F, 4.0F, 12.0F}) {
        for (const Way& way : {Way{"smaa_t2x", "30", "surface", false}, Way{"smaa_t2x", "0", "surface", false},
                               Way{"smaa_t2x", "0", "surface", true}, Way{"smaa_4x", "0", "surface", false}}) {
            SCOPED_TRACE(std::string(way.mode) + ", " + std::to_string(pixels_a_frame) + " pixels a frame, falloff " +
                         way.falloff + (way.from_rest ? ", from rest" : ""));
            EXPECT_LE(left_of_ghost(way, pixels_a_frame), 0.01);
        }
    }
}

TEST_F(Ghosts, AreThereWithoutWeightOrRejection) {
    EXPECT_GT(left_of_ghost({"smaa_t2x", "0", "none", false}, 4), 0.05);
    // The weight looks at speeds, and what starts to move had none.
    EXPECT_GT(left_of_ghost({"smaa_t2x", "30", "none", true}, 4), 0.05);
    // 1920 pixels, half a pixel a frame.
    EXPECT_GT(left_of_ghost({"smaa_t2x", "5", "none", false}, 0.5F), 0.05);
}

}  // namespace
}  // namespace blush
