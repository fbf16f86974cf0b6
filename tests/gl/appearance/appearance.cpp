// Wrinkles and blood on the GPU: laws first, then the CPU's twin, then frames with and without.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "rig/blood/colour_difference.h"
#include "runtime/appearance/appearance_gpu.h"
#include "runtime/appearance/signed_texture.h"
#include "runtime/draw/shading.h"
#include "runtime/files/appearance_file.h"
#include "runtime/gl/state_guard.h"
#include "runtime/measure/appearance_probe.h"
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
        for (std::uint32_t i = 0; i < 64; ++i) set.masks[z].values[i] = (i + z) % set.masks.size() == 0 ? 1.0F : 0.0F;
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

// Maps of a part of the layout: the same folds within it, and none outside.
TEST_F(Appearance, WrinklesOfAPartOfTheLayoutEqualTheCpu) {
    const Face face = expressive_face();
    const Rig rig(face);
    WrinkleSet set = waves(rig, 0.8F, 1);
    set.part = {{0.25F, 0.5F}, {0.75F, 0.9F}};
    for (ScalarMap& mask : set.masks) {
        for (std::uint32_t i = 0; i < 64; ++i) {
            if (i % 8 == 0 || i % 8 == 7 || i / 8 == 0 || i / 8 == 7) mask.values[i] = 0;
        }
    }
    const auto probe = AppearanceProbe::create(device_, face, {set, std::nullopt});
    ASSERT_NE(probe, nullptr);
    ASSERT_TRUE(probe->character().set("wrinkles.storage", "half_float"));
    EXPECT_LT(probe->normal_error(0.7F).worst, 0.4) << "degrees";
    const std::vector<glm::vec3> normals = probe->normals(0.7F);
    std::size_t bent = 0;
    for (std::uint32_t i = 0; i < normals.size(); ++i) {
        const glm::vec2 uv = (glm::vec2(i % AppearanceProbe::side, i / AppearanceProbe::side) + 0.5F) /
                             static_cast<float>(AppearanceProbe::side);
        const glm::vec2 in = set.part.within(uv);
        const bool inside = in.x > 0 && in.x < 1 && in.y > 0 && in.y < 1;
        if (!inside) {
            EXPECT_EQ(normals[i], glm::vec3(0, 0, 1)) << i;
        }
        bent += normals[i] != glm::vec3(0, 0, 1) ? 1U : 0U;
    }
    EXPECT_GT(bent, normals.size() / 10);
    EXPECT_LT(bent, normals.size() / 5);
    // The alternative shows the same at full weight.
    ASSERT_TRUE(probe->character().set("wrinkles.encoding", "differences"));
    const std::vector<glm::vec3> other = probe->normals(0.7F);
    for (std::uint32_t i = 0; i < normals.size(); ++i) {
        if (normals[i] == glm::vec3(0, 0, 1)) {
            EXPECT_EQ(other[i], normals[i]);
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

// The paper has its base map in 3Dc too (8.3). Slopes up to 22 degrees, whole waves within a block of 4 x 4: no texel
// is off by more than a fourteenth of their extent of 0.8 in either channel, 4.6 degrees.
TEST_F(Appearance, BaseNormalsAreNearTheVectorsOfTheirImage) {
    const gl::StateGuard guard;
    const Image image = test::waffle_normal_map();
    const BaseNormalError floats = base_normal_error(image, GL_RG16F), bytes = base_normal_error(image, GL_RG8_SNORM),
                          compressed = base_normal_error(image);
    std::printf("mean and worst, degrees: halves %.3f %.3f, two bytes %.3f %.3f, RGTC2 %.3f %.3f\n", floats.mean,
                floats.worst, bytes.mean, bytes.worst, compressed.mean, compressed.worst);
    EXPECT_LT(floats.worst, 0.05);
    EXPECT_LT(bytes.worst, 0.35);  // half a step of 1 / 127 in both channels
    EXPECT_LT(compressed.worst, 4.6);
    EXPECT_GT(compressed.worst, bytes.worst) << "a compression that loses nothing would be none";
}

TEST_F(Appearance, SteepBaseMapsGetAWiderRange) {
    NormalMap flat(100, 100, glm::vec3(0, 0, 1));
    EXPECT_EQ(base_normal_range(flat), 1);
    for (std::size_t i = 0; i < 9; ++i) flat.values[i] = {1, 0, 0.1F};
    EXPECT_EQ(base_normal_range(flat), 1) << "not for less than a thousandth of the texels";
    for (std::size_t i = 0; i < 100; ++i) flat.values[i] = {2, 0, 1};
    EXPECT_FLOAT_EQ(base_normal_range(flat), 2);
    for (std::size_t i = 0; i < 100; ++i) flat.values[i] = {1, 0, -1};
    EXPECT_EQ(base_normal_range(flat), 4) << "no further";
    EXPECT_EQ(base_normal_range(NormalMap()), 1);
}

class AppearanceFrames : public test::GlTest {
protected:
    Portrait character() {
        Portrait made = make_character(expressive_face());
        made.set_appearance({waves(made.rig(), 0.8F, 1), pigments(made.rig())});
        return made;
    }
    static const EffectReport& report_of(const FrameReport& report, std::string_view effect) {
        return *std::ranges::find(report.effects, effect, &EffectReport::effect);
    }
};

/// Whether any program of the device was made for an effect.
bool is_shaded_with(Portrait& made, std::string_view effect) {
    const ShadingLayout& layout = shading_layout(made.frame().shared);
    const auto& programs = made.frame().shared_own<ShadePrograms>().made;
    return std::ranges::any_of(programs, [&](const auto& program) {
        for (std::size_t k = 0; k < layout.parts.size(); ++k) {
            const bool in = (program.first.shading.parts >> k & 1U) != 0;
            if (in && layout.parts[k].effect->name == effect) return true;
        }
        return false;
    });
}

TEST_F(AppearanceFrames, CostNothingAtRestAndSayWhy) {
    Portrait made = character();
    const Offscreen offscreen = make_offscreen(64, 64);
    test::draw(made, offscreen);
    const FrameReport& report = made.report();
    EXPECT_FALSE(report_of(report, "wrinkles").on);
    EXPECT_EQ(report_of(report, "wrinkles").reason, "no zone of the face is pressed together or smoothed");
    EXPECT_FALSE(report_of(report, "blood").on);
    EXPECT_EQ(report_of(report, "blood").reason,
              "the blood is as it is at rest: the skin has the colour of its texture");
    for (const PassReport& pass : report.passes) EXPECT_NE(pass.name, "blend blood");
    EXPECT_TRUE(is_shaded_with(made, "reflection"));
    EXPECT_FALSE(is_shaded_with(made, "wrinkles"));
    EXPECT_FALSE(is_shaded_with(made, "blood"));
    EXPECT_FALSE((made.state().model->own<std::array<WrinkleTextures, 3>>()[0].masks))
        << "nothing is uploaded for it either";
    EXPECT_FALSE(made.state().model->own<BloodTextures>().pigments);

    made.set(*made.control("anger"), 1);
    test::draw(made, offscreen);
    EXPECT_TRUE(is_shaded_with(made, "wrinkles"));
    EXPECT_TRUE(is_shaded_with(made, "blood"));
    EXPECT_EQ(std::ranges::count(made.report().passes, "blend blood", &PassReport::name), 1);
    // Back at zero the passes are those of a face without maps.
    made.set(*made.control("anger"), 0);
    test::draw(made, offscreen);
    Portrait bare = make_character(expressive_face());
    bare.set(*bare.control("anger"), 1);
    test::draw(bare, offscreen);
    bare.set(*bare.control("anger"), 0);
    test::draw(bare, offscreen);
    const auto names = [](Portrait& of) {
        std::vector<std::string_view> result;
        for (const PassReport& pass : of.report().passes) result.push_back(pass.name);
        return result;
    };
    EXPECT_EQ(names(made), names(bare));
}

TEST_F(AppearanceFrames, ChangeThePictureWhenTheyAct) {
    Portrait made = character();
    const Offscreen offscreen = make_offscreen(96, 96);
    made.set(*made.control("anger"), 1);
    const Image both = test::draw(made, offscreen);
    EXPECT_TRUE(report_of(made.report(), "wrinkles").on);
    EXPECT_TRUE(report_of(made.report(), "blood").on);
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
    Portrait made = character();
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
    ViewFrame view = test::framed_view(made, offscreen);
    made.set(*made.control("surprise"), 1);
    bool left_out = false;
    for (int step = 0; step < 12 && !left_out; ++step) {
        camera.distance *= 1.5F;
        view.camera = camera.camera(1);
        ASSERT_TRUE(made.set("wrinkles.least_pixels_a_mm", least));
        const Image plain = test::draw(made, offscreen, view);
        const EffectReport report = report_of(made.report(), "wrinkles");
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

// Both 127 and 128 are within half a step of flat.
TEST_F(AppearanceFrames, AFlatBaseMapGivesTheGeometricNormalToTheBit) {
    const Offscreen offscreen = make_offscreen(64, 64);
    Portrait bare = make_character(expressive_face());
    const Image without = test::draw(bare, offscreen);
    for (const std::uint8_t flat : {std::uint8_t{127}, std::uint8_t{128}}) {
        Face face = expressive_face();
        face.images.push_back({"flat", 4, 4, 3, {}, {}});
        for (int i = 0; i < 16; ++i) face.images[0].bytes.insert(face.images[0].bytes.end(), {flat, flat, 255});
        face.materials[0].normal.image = 0;
        Portrait mapped = make_character(std::move(face));
        EXPECT_EQ(test::draw(mapped, offscreen).bytes, without.bytes);
    }
    Face face = expressive_face();
    face.images.push_back(test::waffle_normal_map());
    face.materials[0].normal.image = 0;
    Portrait waffle = make_character(std::move(face));
    EXPECT_NE(test::draw(waffle, offscreen).bytes, without.bytes);
}

/// CIEDE2000 of the pixel that differs most.
double worst_difference(const Image& a, const Image& b) {
    double worst = 0;
    for (std::size_t i = 0; i + 3 < a.bytes.size(); i += 4) {
        const auto colour = [&](const Image& image) {
            const auto linear = [&](std::size_t c) { return linear_from_srgb(image.bytes[i + c] / 255.0); };
            return glm::dvec3(linear(0), linear(1), linear(2));
        };
        worst = std::max(worst, ciede2000_of_srgb_linear(colour(a), colour(b)));
    }
    return worst;
}

// Base colour from the two maps and the residual, against the texture that they were made from. At texels they agree
// to the rounding of 8 bits; between them, where skin ends within one texel, the product of filtered maps is not the
// filtered product.
TEST_F(AppearanceFrames, ColourOfPigmentsIsThatOfTheTexture) {
    Face face = expressive_face();
    face.images.push_back({"skin", 64, 64, 3, {}, {}});
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        const auto shade = static_cast<std::uint8_t>(i % 64 / 4 + i / 64 / 4);
        const std::uint8_t red = static_cast<std::uint8_t>(200 + shade), green = static_cast<std::uint8_t>(150 - shade),
                           blue = i / 64 < 8 ? std::uint8_t{250} : std::uint8_t{125};  // a band that is no skin
        face.images[0].bytes.insert(face.images[0].bytes.end(), {red, green, blue});
    }
    face.materials[0].base_color_srgb.image = 0;
    face.materials[0].base_color_linear = glm::vec4(1);
    const Result<ColourMap> albedo = colour_map_of(face.images[0], "skin");
    ASSERT_TRUE(albedo);
    SkinPigments made;
    made.maps = appearance_from_albedo(*albedo, SkinColourTable());
    Portrait character = make_character(std::move(face));
    character.set_appearance({std::nullopt, made});
    const Offscreen offscreen = make_offscreen(64, 64);
    const Image texture = test::draw(character, offscreen);
    ASSERT_TRUE(character.set("blood.colour", "pigments"));
    const Image pigments = test::draw(character, offscreen);
    EXPECT_TRUE(report_of(character.report(), "blood").on);
    EXPECT_LT(worst_difference(pigments, texture), 2);

    // What is painted shows, in the frame where the colour comes from the maps alone: a mole, and lipstick.
    const auto painted = [&](auto paint) {
        SkinPigments other = made;
        for (std::uint32_t y = 28; y < 36; ++y)
            for (std::uint32_t x = 28; x < 36; ++x) paint(other.maps, y * 64 + x);
        character.set_appearance({std::nullopt, other});
        return test::draw(character, offscreen);
    };
    const auto mole = [](AppearanceMaps& maps, std::size_t i) { maps.melanin.values[i] = 0.3F; };
    const auto lipstick = [](AppearanceMaps& maps, std::size_t i) {
        maps.residual.values[i] *= glm::vec3(1, 0.3F, 0.4F);
    };
    EXPECT_GT(worst_difference(painted(mole), pigments), 10);
    EXPECT_GT(worst_difference(painted(lipstick), pigments), 10);
    ASSERT_TRUE(character.set("blood.colour", "texture"));
    EXPECT_EQ(painted(lipstick).bytes, texture.bytes);
}

TEST_F(AppearanceFrames, TheTableHasTheSizeThatIsAskedFor) {
    Portrait made = character();
    const Offscreen offscreen = make_offscreen(64, 64);
    made.set(*made.control("anger"), 1);
    const Image fine = test::draw(made, offscreen);
    ASSERT_TRUE(made.set("blood.table_nodes", "128"));
    EXPECT_LT(worst_difference(test::draw(made, offscreen), fine), 1);
    ASSERT_TRUE(made.set("blood.table_nodes", "2"));
    EXPECT_GT(worst_difference(test::draw(made, offscreen), fine), 2) << "two nodes a side are no model";
    EXPECT_FALSE(made.set("blood.table_nodes", "1"));
}

TEST_F(AppearanceFrames, BloodIsBlendedOnceForAPose) {
    Portrait made = character();
    const Offscreen offscreen = make_offscreen(32, 32);
    const auto blends = [&] {
        test::draw(made, offscreen);
        return std::ranges::count(made.report().passes, "blend blood", &PassReport::name);
    };
    made.set(*made.control("joy"), 0.5F);
    EXPECT_EQ(blends(), 1);
    EXPECT_EQ(blends(), 0);
    made.set(*made.control("joy"), 0.6F);
    EXPECT_EQ(blends(), 1);
}

// What is left out since it changes no bit must change none when it is forced on.
TEST_F(AppearanceFrames, LeavingOutIsExact) {
    Portrait made = character();
    const Offscreen offscreen = make_offscreen(64, 64);
    const Image left_out = test::draw(made, offscreen);
    ViewFrame forced = test::framed_view(made, offscreen);
    forced.force_effects = true;
    EXPECT_EQ(test::draw(made, offscreen, forced).bytes, left_out.bytes);
}

TEST_F(AppearanceFrames, MapsForExpressionsThatTheRigLacksAreLeftAlone) {
    Portrait made = character();
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
    Portrait made = character();
    FaceAppearance bare{std::nullopt, pigments(made.rig())};
    bare.pigments->blood = {};
    made.set_appearance(bare);
    made.set(*made.control("anger"), 1);
    const Offscreen offscreen = make_offscreen(32, 32);
    test::draw(made, offscreen);
    EXPECT_TRUE(report_of(made.report(), "blood").on) << "anger's factor acts on the whole face";
}

}  // namespace
}  // namespace blush
