// Wrinkles and blood on the GPU: laws first, then the CPU's twin, then frames with and without.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rig/colour_difference.h"
#include "runtime/appearance_probe.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 32;

/// A face whose rig has the expressions of the library, since its targets are called as ARKit's.
Face expressive_face() {
    Face face = test::make_face({.targets = 3});
    face.targets[0].name = "browInnerUp";
    face.targets[1].name = "mouthSmileLeft";
    face.targets[2].name = "jawOpen";
    return face;
}

WrinkleSet waves(const Rig& rig, float steepest, float range) {
    WrinkleSet set;
    set.zones.assign(rig.wrinkle_zones().begin(), rig.wrinkle_zones().end());
    set.range = range;
    set.derivatives = DerivativeMap(side, side);
    for (std::uint32_t i = 0; i < side * side; ++i)
        set.derivatives.values[i] = {steepest * std::sin(0.4F * static_cast<float>(i % side)),
                                     steepest * std::cos(0.5F * static_cast<float>(i / side))};
    set.masks.assign(set.zones.size(), ScalarMap(8, 8));
    for (std::size_t z = 0; z < set.masks.size(); ++z)
        for (std::uint32_t i = 0; i < 64; ++i) set.masks[z].values[i] = (i + z) % 8 == 0 ? 1.0F : 0.0F;
    return set;
}

SkinPigments pigments(const Rig& rig) {
    SkinPigments result;
    AppearanceMaps& maps = result.maps;
    // A texel a probed point, so that no filter comes between the GPU and the CPU.
    constexpr std::uint32_t points = AppearanceProbe::side;
    maps.melanin = maps.hemoglobin = maps.skin = ScalarMap(points, points);
    maps.residual = ColourMap(points, points, glm::vec3(1));
    for (std::uint32_t i = 0; i < points * points; ++i) {
        const auto byte = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
        maps.melanin.values[i] = stored_fraction(byte(60 + i % 90), largest_melanin);
        maps.hemoglobin.values[i] = stored_fraction(byte(60 + i / points / 5), largest_hemoglobin);
        maps.skin.values[i] = i % points < 32 ? 0.0F : 1.0F;
    }
    for (const std::string& name : rig.hemoglobin_maps()) {
        result.blood.names.push_back(name);
        const auto strength = static_cast<float>(result.blood.names.size());
        HemoglobinChange change{ScalarMap(16, 16, 1 + 0.05F * strength), ScalarMap(16, 16)};
        // Periodic, since the GPU repeats the map and the CPU ends at its edge.
        for (std::uint32_t i = 0; i < 256; ++i)
            change.offset.values[i] =
                0.001F * strength * (1 - std::cos(0.3926991F * (static_cast<float>(i % 16) + 0.5F)));
        result.blood.changes.push_back(change);
    }
    return result;
}

class Appearance : public test::GlTest {
protected:
    std::shared_ptr<AppearanceProbe> probe(float steepest = 0.8F, float range = 1) {
        const Face face = expressive_face();
        const Rig rig(face);
        auto made = AppearanceProbe::create(device_, face, {waves(rig, steepest, range), pigments(rig)});
        EXPECT_NE(made, nullptr);
        return made;
    }
};

TEST_F(Appearance, FlatDerivativesGiveTheGeometricNormalToTheBit) {
    const auto flat = probe(0);
    for (const glm::vec3& n : flat->normals(1)) ASSERT_EQ(n, glm::vec3(0, 0, 1));
    const auto folded = probe();
    for (const glm::vec3& n : folded->normals(0)) ASSERT_EQ(n, glm::vec3(0, 0, 1));
}

// The tolerance is half a step of the stored map and of the masks, on slopes up to 39 degrees, and what RGTC's blocks
// of eight levels lose on waves of 15 texels.
TEST_F(Appearance, WrinklesEqualTheCpu) {
    for (const float range : {1.0F, 4.0F}) {
        const auto made = probe(0.8F, range);
        const double step = glm::degrees(static_cast<double>(range) / 127);
        for (const float weight : {1.0F, 0.6F, -0.6F}) {
            ASSERT_TRUE(made->character().set("wrinkles.storage", "half_float"));
            EXPECT_LT(made->normal_error(weight).worst, 0.25);
            ASSERT_TRUE(made->character().set("wrinkles.storage", "plain"));
            EXPECT_LT(made->normal_error(weight).worst, 0.25 + step);
            ASSERT_TRUE(made->character().set("wrinkles.storage", "compressed"));
            EXPECT_LT(made->normal_error(weight).worst, 4 + 2 * step);
        }
    }
}

TEST_F(Appearance, DifferencesAreDerivativesAtFullWeight) {
    const auto made = probe();
    ASSERT_TRUE(made->character().set("wrinkles.storage", "half_float"));
    const std::vector<glm::vec3> derivatives = made->normals(1);
    ASSERT_TRUE(made->character().set("wrinkles.encoding", "differences"));
    const std::vector<glm::vec3> differences = made->normals(1);
    // Where exactly one zone is at full strength; between masks both are interpolated, along different paths.
    double worst = 0, difference = 0;
    for (std::size_t i = 0; i < derivatives.size(); ++i) {
        difference += static_cast<double>(glm::distance(derivatives[i], differences[i])) /
                      static_cast<double>(derivatives.size());
        worst = std::max(worst, static_cast<double>(glm::distance(derivatives[i], differences[i])));
    }
    EXPECT_LT(difference, 0.02);
    EXPECT_LT(worst, 0.15);
    EXPECT_NE(derivatives, differences);
}

TEST_F(Appearance, BloodAtRestChangesNothing) {
    const auto made = probe();
    for (const glm::vec3& color : made->colors("headYaw")) {
        ASSERT_NEAR(color.r, 1, 2e-3);
        ASSERT_NEAR(color.g, 1, 2e-3);
        ASSERT_NEAR(color.b, 1, 2e-3);
    }
}

// Half floats of the table and of the change map.
TEST_F(Appearance, BloodEqualsTheCpu) {
    const auto made = probe();
    for (const char* control : {"anger", "fear", "joy", "blush"}) {
        const Variant::Error error = made->color_error(control), without = made->color_error(control, false);
        EXPECT_LT(error.mean, 0.5) << control;
        EXPECT_LT(error.worst, 3) << control;
        EXPECT_GT(without.mean, 4 * error.mean) << control;
    }
}

// Up to 7 % of blood, which no face has: beyond it the model has blood take red alone (docs/appearance.md).
TEST_F(Appearance, MoreBloodIsRedder) {
    const auto made = probe();
    const std::vector<glm::vec3> anger = made->colors("anger");
    for (std::size_t i = 0; i < anger.size(); ++i) {
        const auto x = i % AppearanceProbe::side;
        if (x < 32) continue;  // no skin there
        ASSERT_LT(anger[i].g / anger[i].r, 1.001F) << i;
    }
    for (std::size_t i = 0; i < anger.size(); i += AppearanceProbe::side)
        ASSERT_NEAR(anger[i].g, 1, 2e-3) << "not skin";
}

class AppearanceFrames : public test::GlTest {
protected:
    Character character() {
        Character made = make_character(expressive_face());
        made.set_appearance({waves(made.rig(), 0.8F, 1), pigments(made.rig())});
        return made;
    }
    static const EffectReport& report_of(const FrameReport& report, std::string_view effect) {
        return *std::ranges::find(report.effects, effect, &EffectReport::effect);
    }
};

TEST_F(AppearanceFrames, CostNothingAtRestAndSayWhy) {
    Character made = character();
    const Offscreen offscreen = make_offscreen(64, 64);
    test::draw(made, offscreen);
    const FrameReport& report = made.state().report;
    EXPECT_FALSE(report_of(report, "wrinkles").on);
    EXPECT_EQ(report_of(report, "wrinkles").reason, "no zone of the face is pressed together or smoothed");
    EXPECT_FALSE(report_of(report, "blood").on);
    EXPECT_EQ(report_of(report, "blood").reason,
              "the blood is as it is at rest: the skin has the colour of its texture");
    for (const PassReport& pass : report.passes) EXPECT_NE(pass.name, "blend blood");
}

TEST_F(AppearanceFrames, ChangeThePictureWhenTheyAct) {
    Character made = character();
    const Offscreen offscreen = make_offscreen(96, 96);
    made.set(*made.control("anger"), 1);
    const Image both = test::draw(made, offscreen);
    EXPECT_TRUE(report_of(made.state().report, "wrinkles").on);
    EXPECT_TRUE(report_of(made.state().report, "blood").on);
    const FaceAppearance all{waves(made.rig(), 0.8F, 1), pigments(made.rig())};
    made.set_appearance({all.wrinkles, std::nullopt});
    const Image wrinkled = test::draw(made, offscreen);
    made.set_appearance({std::nullopt, all.pigments});
    const Image flushed = test::draw(made, offscreen);
    made.set_appearance({});
    const Image neither = test::draw(made, offscreen);
    EXPECT_NE(both.bytes, wrinkled.bytes);
    EXPECT_NE(both.bytes, flushed.bytes);
    EXPECT_NE(wrinkled.bytes, neither.bytes);
    EXPECT_NE(flushed.bytes, neither.bytes);
    // The background is nobody's skin.
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(both.bytes[c], neither.bytes[c]);
}

// Of a face so small that wrinkles are left out, drawing them changes no pixel by more than the bound that is stated.
TEST_F(AppearanceFrames, LeavingWrinklesOutOfASmallFaceIsWithinItsBound) {
    Character made = character();
    // Folds every 8 mm of a face of 240 mm, as the baker makes them, everywhere at full strength.
    WrinkleSet folds = waves(made.rig(), 0, 1);
    folds.derivatives = DerivativeMap(256, 256);
    for (std::uint32_t i = 0; i < 256 * 256; ++i)
        folds.derivatives.values[i] = {0.2F * std::sin(0.37F * static_cast<float>(i % 256)),
                                       0.6F * std::cos(0.74F * static_cast<float>(i / 256))};
    for (ScalarMap& mask : folds.masks) std::ranges::fill(mask.values, 0.25F);
    made.set_appearance({folds, std::nullopt});
    const std::string least = std::to_string(made.state().settings.number("wrinkles", "least_pixels_a_mm"));
    const Offscreen offscreen = make_offscreen(64, 64);
    OrbitCamera camera = made.framing(1);
    View view = test::framed_view(made, offscreen);
    made.set(*made.control("surprise"), 1);
    bool left_out = false;
    for (int step = 0; step < 12 && !left_out; ++step) {
        camera.distance *= 1.5F;
        view.camera = camera.camera(1);
        ASSERT_TRUE(made.set("wrinkles.least_pixels_a_mm", least));
        const Image plain = test::draw(made, offscreen, view);
        const EffectReport report = report_of(made.state().report, "wrinkles");
        left_out = !report.on;
        if (!left_out) continue;
        EXPECT_EQ(report.omission, Omission::bounded);
        ASSERT_TRUE(made.set("wrinkles.least_pixels_a_mm", "0"));
        const Image forced = test::draw(made, offscreen, view);
        double worst = 0;
        for (std::size_t i = 0; i + 3 < plain.bytes.size(); i += 4) {
            const auto colour = [&](const Image& image) {
                const auto linear = [&](std::size_t c) { return linear_from_srgb(image.bytes[i + c] / 255.0); };
                return glm::dvec3(linear(0), linear(1), linear(2));
            };
            worst = std::max(worst, ciede2000_of_srgb_linear(colour(plain), colour(forced)));
        }
        std::printf("worst pixel: CIEDE2000 %.2f\n", worst);
        EXPECT_LE(worst, report.bound);
    }
    EXPECT_TRUE(left_out);
}

TEST_F(AppearanceFrames, BloodIsBlendedOnceForAPose) {
    Character made = character();
    const Offscreen offscreen = make_offscreen(32, 32);
    const auto blends = [&] {
        test::draw(made, offscreen);
        return std::ranges::count(made.state().report.passes, "blend blood", &PassReport::name);
    };
    made.set(*made.control("joy"), 0.5F);
    EXPECT_EQ(blends(), 1);
    EXPECT_EQ(blends(), 0);
    made.set(*made.control("joy"), 0.6F);
    EXPECT_EQ(blends(), 1);
}

// What is left out since it changes no bit must change none when it is forced on.
TEST_F(AppearanceFrames, LeavingOutIsExact) {
    Character made = character();
    const Offscreen offscreen = make_offscreen(64, 64);
    const Image left_out = test::draw(made, offscreen);
    View forced = test::framed_view(made, offscreen);
    forced.force_effects = true;
    EXPECT_EQ(test::draw(made, offscreen, forced).bytes, left_out.bytes);
}

TEST_F(AppearanceFrames, MapsForExpressionsThatTheRigLacksAreLeftAlone) {
    Character made = character();
    FaceAppearance odd{waves(made.rig(), 0.8F, 1), pigments(made.rig())};
    odd.wrinkles->zones[0] = "elbow";
    odd.pigments->blood.names[0] = "hunger";
    made.set_appearance(odd);
    const Offscreen offscreen = make_offscreen(32, 32);
    for (const std::string& control : made.rig().control_names()) {
        made.set(*made.control(control), 0.5F);
    }
    test::draw(made, offscreen);
}

TEST_F(AppearanceFrames, NoMapsOfBloodAtAll) {
    Character made = character();
    FaceAppearance bare{std::nullopt, pigments(made.rig())};
    bare.pigments->blood = {};
    made.set_appearance(bare);
    made.set(*made.control("anger"), 1);
    const Offscreen offscreen = make_offscreen(32, 32);
    test::draw(made, offscreen);
    EXPECT_TRUE(report_of(made.state().report, "blood").on) << "anger's factor acts on the whole face";
}

}  // namespace
}  // namespace blush
