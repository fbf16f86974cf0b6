// Whole frames: what is left out changes no byte, the same arguments give the same bytes, nothing is blank.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"

namespace blush {
namespace {

using test::draw;
using test::framed_view;
using test::make_face;
using test::set_weights;

const EffectReport& effect_of(const FrameReport& report, std::string_view name) {
    const auto found = std::ranges::find(report.effects, name, &EffectReport::effect);
    if (found != report.effects.end()) return *found;
    ADD_FAILURE() << "no report of effect " << name;
    static const EffectReport none;
    return none;
}

const PassReport* pass_of(const FrameReport& report, std::string_view name) {
    const auto found = std::ranges::find(report.passes, name, &PassReport::name);
    return found != report.passes.end() ? &*found : nullptr;
}

class Frames : public test::GlTest {};

// --- framing
// -----------------------------------------------------------------------

/// Of a place in a square picture, from -1 to 1.
glm::vec2 seen_at(const OrbitCamera& orbit, glm::vec3 place) {
    const Camera camera = orbit.camera(1);
    const glm::vec4 clip = camera.clip_from_view * glm::mat4(camera.view_from_world) * glm::vec4(place, 1);
    return glm::vec2(clip) / clip.w;
}

TEST(Framing, ABustIsFramedByItsHeadInAnyUnit) {
    for (const float unit : {1.0F, 0.001F, 30.0F}) {
        const Bounds bust{unit * glm::vec3(-220, -420, -130), unit * glm::vec3(220, 100, 110)};
        const OrbitCamera orbit = frame_head(bust, {1.0 / static_cast<double>(unit), "its pupils", false}, 1);
        const glm::vec2 crown = seen_at(orbit, unit * glm::vec3(0, 100, 0));
        const glm::vec2 chin = seen_at(orbit, unit * glm::vec3(0, -125, 0));
        EXPECT_LT(crown.y, 0.95F);
        EXPECT_GT(crown.y - chin.y, 1.2F) << "a head fills at least six tenths of the height";
        EXPECT_LT(seen_at(orbit, unit * glm::vec3(0, -420, 0)).y, -1.2F);
        // Both planes leave the whole bust in.
        const Camera camera = orbit.camera(1);
        for (const glm::vec3 corner : {bust.low, bust.high}) {
            const glm::vec4 clip = camera.clip_from_view * glm::mat4(camera.view_from_world) * glm::vec4(corner, 1);
            EXPECT_LE(std::abs(clip.z), clip.w);
        }
    }
}

TEST(Framing, AHeadIsFramedWholeAndNothingIsStillACamera) {
    const Bounds head{glm::vec3(-80, -140, -100), glm::vec3(80, 120, 100)};
    const OrbitCamera orbit = frame_head(head, {1, "its pupils", false}, 1);
    EXPECT_EQ(orbit.target_world, glm::dvec3(head.centre()));
    for (const glm::vec3 corner : {head.low, head.high}) {
        EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::abs(seen_at(orbit, corner)), glm::vec2(1))));
    }
    const float infinity = std::numeric_limits<float>::infinity();
    for (const Bounds& bounds : {Bounds{}, Bounds{glm::vec3(-infinity), glm::vec3(infinity)}}) {
        const OrbitCamera home = frame_head(bounds, {1, "its pupils", false}, 1);
        EXPECT_TRUE(std::isfinite(home.distance) && home.distance > 0);
    }
    const Bounds bust{glm::vec3(-220, -420, -130), glm::vec3(220, 100, 110)};
    EXPECT_EQ(frame_head(bust, {1, "a guess", true}, 1).target_world, glm::dvec3(bust.centre()));
}

// --- promise: an exact omission changes no byte
// -----------------------------------------------------------------------

struct Scene {
    const char* name;
    test::FaceOptions options;
    std::vector<float> weights;
    std::function<void(Portrait&)> arrange = [](Portrait&) {};
};

std::vector<Scene> scenes() {
    const auto turn_joint = [](Portrait& character) {
        character.pose().nodes[1].rotation = rotation_of(glm::angleAxis(0.5F, glm::vec3(0, 0, 1)));
    };
    const auto recomputed = [](Portrait& character) { ASSERT_TRUE(character.set("normals.source", "recomputed")); };
    const auto in_passes = [](Portrait& character) { ASSERT_TRUE(character.set("deformation.method", "passes")); };
    return {
        {"at rest", {.targets = 4, .normal_deltas = true}, {0, 0, 0, 0}},
        {"at rest without authored normals", {.targets = 4, .seam = true, .normal_map = true}, {0, 0, 0, 0}},
        {"at rest, all recomputed", {.targets = 4, .normal_deltas = true}, {0, 0, 0, 0}, recomputed},
        {"at rest, in passes", {.targets = 4, .tangent_deltas = true}, {0, 0, 0, 0}, in_passes},
        {"authored",
         {.targets = 4, .normal_deltas = true, .tangent_deltas = true, .normal_map = true},
         {1, 0, 0.5F, 0}},
        {"recomputed", {.targets = 4, .normal_map = true}, {1, 0, 0.5F, -0.5F}},
        {"only authored targets of a mixed face",
         {.targets = 4, .normal_deltas = true, .odd_without_normals = true, .two_primitives = true},
         {1, 0, 1, 0}},
        {"skinned, at rest", {.targets = 2, .joints = true}, {0, 0}, turn_joint},
        {"skinned and deformed", {.targets = 2, .joints = true}, {0.6F, 1}, turn_joint},
        {"no targets at all", {.targets = 0}, {}},
    };
}

TEST_F(Frames, ForcingEveryEffectChangesNoByte) {
    for (const Scene& scene : scenes()) {
        SCOPED_TRACE(scene.name);
        const Face face = make_face(scene.options);
        for (const Output output : {Output::display_srgb, Output::linear_hdr}) {
            const Offscreen offscreen = make_offscreen(48, 48, output);
            Portrait plain = make_character(face), forced = make_character(face);
            for (Portrait* character : {&plain, &forced}) {
                set_weights(*character, scene.weights);
                scene.arrange(*character);
            }
            const ViewFrame view = framed_view(plain, offscreen);
            ViewFrame forced_view = view;
            forced_view.force_effects = true;
            for (int frame = 0; frame < 2; ++frame) {  // in the second one nothing changed
                const Image without = draw(plain, offscreen, view);
                const Image with = draw(forced, offscreen, forced_view);
                EXPECT_EQ(without.bytes, with.bytes) << "frame " << frame;
                EXPECT_EQ(without.floats, with.floats) << "frame " << frame;
                EXPECT_TRUE(effect_of(forced.draw(forced_view), "deformation").on);
            }
        }
    }
}

TEST_F(Frames, ForcedAndUnforcedFramesOfOneCharacterMayFollowEachOther) {
    const Face face = make_face({.targets = 3});
    const Offscreen offscreen = make_offscreen(48, 48);
    Portrait mixed = make_character(face);
    ViewFrame view = framed_view(mixed, offscreen);
    const std::vector<std::vector<float>> weights = {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1, 0}};
    for (std::size_t frame = 0; frame < weights.size(); ++frame) {
        Portrait fresh = make_character(face);
        set_weights(mixed, weights[frame]);
        set_weights(fresh, weights[frame]);
        view.force_effects = frame % 2 == 1;
        const Image image = draw(mixed, offscreen, view);
        view.force_effects = false;
        EXPECT_EQ(image.bytes, draw(fresh, offscreen, view).bytes) << "frame " << frame;
    }
}

TEST_F(Frames, UnchangedWeightsAreNotDeformedAgain) {
    Portrait character = make_character(make_face({.targets = 3}));
    const Offscreen offscreen = make_offscreen(48, 48);
    const ViewFrame view = framed_view(character, offscreen);
    set_weights(character, {0.5F, 0, 1});
    const Image first = draw(character, offscreen, view);
    FrameReport report = character.draw(view);
    EXPECT_EQ(report.deltas_added, 0U);
    EXPECT_FALSE(effect_of(report, "deformation").on);
    EXPECT_EQ(effect_of(report, "deformation").reason,
              "weights and settings are those of an earlier frame, whose result still stands");
    EXPECT_EQ(effect_of(report, "deformation").omission, Omission::exact);
    EXPECT_FALSE(effect_of(report, "normals").on);
    EXPECT_EQ(pass_of(report, "deform"), nullptr);
    EXPECT_EQ(offscreen.read().bytes, first.bytes);

    set_weights(character, {0.5F, 0, 0.9F});
    report = character.draw(view);
    const auto& targets = character.face().targets;
    EXPECT_EQ(report.deltas_added, targets[0].vertices.size() + targets[2].vertices.size());
    EXPECT_TRUE(effect_of(report, "deformation").on);
    EXPECT_TRUE(effect_of(report, "normals").on);
    ASSERT_NE(pass_of(report, "deform"), nullptr);
    EXPECT_TRUE(pass_of(report, "deform")->ran);
    EXPECT_EQ(report.characters[0].active.size(), 2U);
    EXPECT_NE(offscreen.read().bytes, first.bytes);

    // A setting changed: the result that stands is of other settings.
    ASSERT_TRUE(character.set("deformation.method", "passes"));
    EXPECT_TRUE(effect_of(character.draw(view), "deformation").on);
}

TEST_F(Frames, ReportsWhatIsLeftOutAndWhy) {
    Portrait character = make_character(make_face({.targets = 2, .normal_deltas = true}));
    const Offscreen offscreen = make_offscreen(16, 16);
    const ViewFrame view = framed_view(character, offscreen);
    const FrameReport& report = character.draw(view);
    EXPECT_EQ(effect_of(report, "deformation").reason,
              "no target has a weight other than zero: the rest surface is drawn as it is");
    EXPECT_EQ(effect_of(report, "normals").reason,
              "the deformation adds up all normals: each target that moves the surface brings its own");
    EXPECT_EQ(effect_of(report, "skinning").reason, "the face has no joints");
    // Once for the camera and once for each of the two portrait lights that cast shadows.
    EXPECT_EQ(report.triangles_drawn, 3 * character.face().indices.size() / 3);
}

// --- the same arguments give the same bytes ------------------------------------------------------------------------

TEST_F(Frames, TwoContextsGiveTheSameBytes) {
    const Device other = make_device();
    const Face face = make_face({.targets = 4, .seam = true, .normal_map = true});
    Image images[2];
    const Device* devices[] = {&device_, &other};
    for (std::size_t i = 0; i < 2; ++i) {
        Portrait character = make_character(*devices[i], face);
        set_weights(character, {0.4F, 1, 0, -0.2F});
        const Result<Offscreen> offscreen = Offscreen::create(*devices[i], 64, 48, Output::display_srgb);
        ASSERT_TRUE(offscreen);
        images[i] = draw(character, *offscreen);
    }
    EXPECT_EQ(images[0].bytes, images[1].bytes);
    EXPECT_GE(test::colour_count(images[0]), test::fewest_colours);
    test::expect_no_debug_messages(other);
}

TEST_F(Frames, AFaceIsNeverBlankAndMovesWhereItShould) {
    Portrait character = make_character(make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(64, 64);
    const Image rest = draw(character, offscreen);
    EXPECT_GE(test::colour_count(rest), test::fewest_colours);
    set_weights(character, {1});
    const Image moved = draw(character, offscreen);
    std::size_t differing = 0;
    for (std::size_t p = 0; p < rest.bytes.size(); p += 4) {
        differing += std::equal(&rest.bytes[p], &rest.bytes[p] + 4, &moved.bytes[p]) ? 0U : 1U;
    }
    EXPECT_GT(differing, 50U);        // the target is seen
    EXPECT_LT(differing, 64U * 64U);  // and only where it moves something
    for (const std::size_t corner : {0U, 63U, 64U * 63U, 64U * 64U - 1U}) {
        EXPECT_TRUE(std::equal(&rest.bytes[corner * 4], &rest.bytes[corner * 4] + 4, &moved.bytes[corner * 4]));
    }
}

TEST_F(Frames, AViewWithoutPixelsDrawsNothing) {
    Portrait character = make_character(make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(16, 16);
    const ViewFrame view = framed_view(character, offscreen);
    const Image before = draw(character, offscreen, view);
    set_weights(character, {1});
    for (const auto& [width, height] : {std::pair(0U, 0U), std::pair(16U, 0U), std::pair(0U, 16U)}) {
        ViewFrame empty = view;
        empty.width = width;
        empty.height = height;
        const FrameReport& report = character.draw(empty);
        EXPECT_TRUE(report.passes.empty());
        EXPECT_TRUE(report.effects.empty());
        EXPECT_EQ(report.triangles_drawn, 0U);
        EXPECT_EQ(offscreen.read().bytes, before.bytes);
    }
}

TEST_F(Frames, OffscreenOfAnImpossibleSizeIsAnError) {
    const std::string limit = std::to_string(device_.info().largest_texture_side_texels);
    for (const auto& [width, height] : {std::pair(0U, 0U), std::pair(8U, 0U), std::pair(0U, 8U),
                                        std::pair(100'000U, 100'000U), std::pair(1U, 4'294'967'295U)}) {
        const Result<Offscreen> made = Offscreen::create(device_, width, height, Output::display_srgb);
        ASSERT_FALSE(made);
        EXPECT_EQ(made.error().message, "size " + std::to_string(width) + "x" + std::to_string(height) +
                                            ": a side may be 1 to " + limit + " pixels");
    }
}

// --- the filmic curve, in double precision
// ------------------------------------------------------------------------------

/// Hable (2010) and IEC 61966-2-1, as shaders/camera/tone.frag has them.
double display_from_radiance(double radiance, double exposure) {
    const auto filmic = [](double x) {
        return (x * (0.15 * x + 0.10 * 0.50) + 0.20 * 0.02) / (x * (0.15 * x + 0.50) + 0.20 * 0.30) - 0.02 / 0.30;
    };
    const double mapped = std::clamp(filmic(2.0 * exposure * std::max(radiance, 0.0)) / filmic(11.2), 0.0, 1.0);
    return mapped <= 0.0031308 ? 12.92 * mapped : 1.055 * std::pow(mapped, 1 / 2.4) - 0.055;
}

TEST_F(Frames, DisplayOutputIsTheCurveOfTheLinearOutput) {
    Portrait character = make_character(make_face({.targets = 1}));
    ASSERT_TRUE(character.set("multisampling.resolve", "average"));  // else each output has its own
    const Offscreen display = make_offscreen(48, 40), linear = make_offscreen(48, 40, Output::linear_hdr);
    for (const float exposure : {0.25F, 1.0F, 6.0F}) {
        ViewFrame display_view = framed_view(character, display), linear_view = framed_view(character, linear);
        display_view.exposure = linear_view.exposure = exposure;
        const Image shown = draw(character, display, display_view), radiance = draw(character, linear, linear_view);
        ASSERT_EQ(shown.bytes.size(), radiance.floats.size());
        double worst = 0;
        for (std::size_t i = 0; i < shown.bytes.size(); ++i) {
            if (i % 4 == 3) continue;
            const double expected =
                display_from_radiance(static_cast<double>(radiance.floats[i]), static_cast<double>(exposure));
            worst = std::max(worst, std::abs(shown.bytes[i] / 255.0 - expected));
        }
        EXPECT_LE(worst, 1.0 / 255) << "exposure " << exposure;
    }
}

// --- check_finite and timing
// -------------------------------------------------------------------------------------------

TEST_F(Frames, AFiniteFrameReportsNothing) {
    Portrait character = make_character(make_face({.targets = 2, .joints = true}));
    set_weights(character, {1, 1});
    const Offscreen offscreen = make_offscreen(32, 32);
    EXPECT_FALSE(character.draw(framed_view(character, offscreen)).not_finite);
}

TEST_F(Frames, NamesThePassThatOverflows) {
    Face face = make_face({.targets = 1});
    face.targets[0].vertices = {17};
    face.targets[0].position_deltas = {{0, 3e38F, 0}};
    face.positions[17].y = 3e38F;
    ASSERT_TRUE(validate(face));
    Portrait character = make_character(std::move(face));
    const Offscreen offscreen = make_offscreen(16, 16);
    set_weights(character, {1});
    const FrameReport& report = character.draw(framed_view(character, offscreen));
    ASSERT_TRUE(report.not_finite);
    EXPECT_EQ(report.not_finite->pass, "deform");
    EXPECT_EQ(report.not_finite->resource, "surface positions");
    EXPECT_EQ(report.not_finite->place, "vertex 17 component 1");
    EXPECT_EQ(report.not_finite->sentence(),
              "pass \"deform\" wrote inf to \"surface positions\" at vertex 17 component 1");
}

TEST_F(Frames, NamesWhatIsNotFiniteBehindTheLoadersBack) {
    const Face face = make_face({.targets = 1});
    Portrait character = make_character(face);
    // The rest buffers are immutable to the CPU, so the damage is copied in on the GPU.
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const gl::Buffer damage = gl::make_buffer(sizeof(nan), &nan);
    const std::uint32_t victim = face.targets[0].vertices[3];
    glCopyNamedBufferSubData(damage.name(), character.state().stream_out.rest().positions.name(), 0,
                             static_cast<GLintptr>(victim * sizeof(glm::vec3) + 2 * sizeof(float)), sizeof(nan));
    const Offscreen offscreen = make_offscreen(16, 16);
    set_weights(character, {1});
    const FrameReport& report = character.draw(framed_view(character, offscreen));
    ASSERT_TRUE(report.not_finite);
    EXPECT_EQ(report.not_finite->pass, "deform");
    EXPECT_EQ(report.not_finite->resource, "surface positions");
    EXPECT_EQ(report.not_finite->place, "vertex " + std::to_string(victim) + " component 2");
    EXPECT_TRUE(std::isnan(report.not_finite->value));
}

TEST_F(Frames, NamesThePixelBeyondHalfPrecision) {
    Portrait character = make_character(make_face({.targets = 0}));
    const Offscreen offscreen = make_offscreen(16, 16);
    for (const std::uint32_t samples : {1U, 4U}) {
        ViewFrame view = framed_view(character, offscreen);
        view.samples = samples;
        view.background_linear = {0, 1e6F, 0, 1};  // half floats end at 65504
        const FrameReport& report = character.draw(view);
        ASSERT_TRUE(report.not_finite) << samples << " samples";
        EXPECT_EQ(report.not_finite->pass, "shade");
        EXPECT_EQ(report.not_finite->resource, "scene colour, multisampled");
        EXPECT_EQ(report.not_finite->place, "pixel (0, 15) channel 1");
    }
}

TEST_F(Frames, PassesHaveTimesOnlyWhenTheViewAsks) {
    Portrait character = make_character(make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(32, 32);
    ViewFrame view = framed_view(character, offscreen);
    view.check_finite = false;
    set_weights(character, {1});
    for (const PassReport& pass : character.draw(view).passes) EXPECT_EQ(pass.milliseconds, 0) << pass.name;
    view.timed = true;
    set_weights(character, {0.5F});
    double total = 0;
    for (const PassReport& pass : character.draw(view).passes) {
        EXPECT_TRUE(pass.ran) << pass.name;
        EXPECT_GE(pass.milliseconds, 0) << pass.name;
        EXPECT_TRUE(std::isfinite(pass.milliseconds)) << pass.name;
        total += pass.milliseconds;
    }
    EXPECT_GT(total, 0);
}

}  // namespace
}  // namespace blush
