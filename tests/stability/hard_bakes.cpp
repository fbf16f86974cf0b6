// Promise 2 for what is made ahead: every hard case of a baker, with both ends of its settings, is baked into finite
// maps or refused in a sentence.

#include <gtest/gtest.h>

#include <cmath>

#include "rig/blood/skin_inversion.h"
#include "runtime/bake/baker.h"
#include "runtime/files/appearance_file.h"
#include "runtime/files/wrinkle_bake.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

bool finite(const ScalarMap& map) {
    return std::ranges::all_of(map.values, [](float value) { return std::isfinite(value); });
}

/// Of skin that expressions move, with a texture.
Face expressive_face() {
    Face face = test::make_face({.side = 14, .targets = 4, .normal_map = true});
    constexpr std::array<const char*, 4> names = {"eyeBlinkLeft", "eyeBlinkRight", "mouthSmileLeft", "browInnerUp"};
    for (std::size_t t = 0; t < names.size(); ++t) face.targets[t].name = names[t];
    return face;
}

/// Error: refused; else whether all is finite.
Result<bool> bakes_finite_wrinkles(const Face& face, float spacing_mm, float range, bool whole_layout) {
    WrinkleBakeOptions options;
    options.maps.map_side = 32;
    options.maps.mask_side = 8;
    options.maps.spacing_mm = spacing_mm;
    options.range = range;
    options.whole_layout = whole_layout;
    options.millimetres_a_unit = 100;
    const Result<BakedWrinkles> baked = bake_wrinkle_set(face, options);
    if (!baked) return baked.error();
    const bool derivatives = std::ranges::all_of(baked->set.derivatives.values,
                                                 [](glm::vec2 d) { return std::isfinite(d.x) && std::isfinite(d.y); });
    return derivatives && std::isfinite(baked->set.range) && std::ranges::all_of(baked->set.masks, finite) &&
           finite(baked->displacement_mm);
}

TEST(HardBakes, AnOrdinaryFaceIsBakedSoThatTheOthersMayBeRefused) {
    const Result<bool> baked = bakes_finite_wrinkles(expressive_face(), 8, 0, false);
    ASSERT_TRUE(baked) << baked.error().message;
    EXPECT_TRUE(*baked);
}

TEST(HardBakes, WrinklesAreFiniteOrRefused) {
    for (const HardCase& hard : wrinkle_baker.hard_cases) {
        SCOPED_TRACE(hard.name);
        Face face = expressive_face();
        hard.make(face);
        const Status valid = validate(face);
        ASSERT_TRUE(valid) << valid.error().message;
        for (const float spacing_mm : {0.5F, 8.0F, 50.0F}) {
            for (const float range : {0.0F, 100.0F}) {
                for (const bool whole : {false, true}) {
                    const Result<bool> baked = bakes_finite_wrinkles(face, spacing_mm, range, whole);
                    if (baked) {
                        EXPECT_TRUE(*baked) << "spacing " << spacing_mm << ", range " << range << ", whole " << whole;
                    } else {
                        EXPECT_NE(baked.error().message.find(' '), std::string::npos) << baked.error().message;
                    }
                }
            }
        }
    }
}

TEST(HardBakes, PigmentsAreFiniteAndKeepTheColour) {
    const SkinColourTable table;
    for (const HardCase& hard : appearance_baker.hard_cases) {
        SCOPED_TRACE(hard.name);
        Face face = expressive_face();
        hard.make(face);
        ASSERT_FALSE(face.images.empty());
        const Result<ColourMap> albedo = colour_map_of(face.images[0], face.path);
        ASSERT_TRUE(albedo) << albedo.error().message;
        for (const float lightness : {0.0F, 0.35F, 1.0F}) {
            AlbedoOptions options;
            options.lightness_weight = lightness;
            const AppearanceMaps maps = appearance_from_albedo(*albedo, table, options);
            EXPECT_TRUE(finite(maps.melanin) && finite(maps.hemoglobin) && finite(maps.skin));
            const ColourMap again = recomposed(maps, table);
            for (std::size_t i = 0; i < again.values.size(); ++i) {
                for (glm::length_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(again.values[i][c], albedo->values[i][c], 1e-3) << "lightness " << lightness;
                }
            }
        }
    }
}

}  // namespace
}  // namespace blush
