#include "rig/blood/appearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_inversion.h"

namespace blush {
namespace {

const SkinColourTable& table() {
    static const SkinColourTable shared;
    return shared;
}

TEST(SkinInversion, FindsWhatMadeTheColour) {
    for (const float lightness : {0.35F, 1.0F}) {
        const SkinInverter inverter(table(), glm::vec3(1), lightness);
        for (const float melanin : {0.01F, 0.03F, 0.08F, 0.2F}) {
            for (const float hemoglobin : {0.005F, 0.02F, 0.06F}) {
                const SkinReading reading = inverter.read(table().colour_linear(melanin, hemoglobin));
                // The search walks a grid of its own; its chords differ from the table's.
                EXPECT_NEAR(table_coordinate(reading.melanin, 0.5), table_coordinate(melanin, 0.5), 0.006F);
                EXPECT_NEAR(table_coordinate(reading.hemoglobin, 0.32), table_coordinate(hemoglobin, 0.32), 0.006F);
                EXPECT_NEAR(reading.shading, 1, 0.02F);
                EXPECT_LT(reading.chroma_error, 0.005F);
            }
        }
    }
}

TEST(SkinInversion, ExplainsEveryColourOfTheTable) {
    // At lightness 0 the chroma of dark, blood-rich skin comes twice in the table; either point explains it.
    for (const float lightness : {0.0F, 0.35F, 1.0F}) {
        const SkinInverter inverter(table(), glm::vec3(1), lightness);
        for (float v = 0.02F; v < 1; v += 0.07F) {
            for (float u = 0.02F; u < 1; u += 0.07F) {
                const glm::vec3 colour = table().colour_linear_at({u, v});
                const SkinReading reading = inverter.read(colour);
                const glm::vec3 found = reading.shading * table().colour_linear(reading.melanin, reading.hemoglobin);
                EXPECT_LT(ciede2000_of_srgb_linear(glm::dvec3(found), glm::dvec3(colour)), 1) << u << " " << v;
            }
        }
    }
}

TEST(SkinInversion, LightChangesShadingAlone) {
    const SkinInverter inverter(table(), glm::vec3(1), 0);
    const glm::vec3 colour = table().colour_linear(0.03F, 0.03F);
    const SkinReading bright = inverter.read(colour), dim = inverter.read(0.5F * colour);
    EXPECT_NEAR(dim.melanin, bright.melanin, 1e-4F);
    EXPECT_NEAR(dim.hemoglobin, bright.hemoglobin, 1e-4F);
    EXPECT_NEAR(dim.shading, 0.5F * bright.shading, 1e-3F);
}

TEST(SkinInversion, NearestPointOfEveryColourIsFound) {
    // Against the least over all nodes of a fine grid; the search may only be better.
    const SkinInverter inverter(table(), glm::vec3(1), 0.35F);
    const glm::vec3 weights(0.35F, 1, yellowness_weight);
    for (const float r : {0.02F, 0.2F, 0.5F, 0.9F}) {
        for (const float g : {0.02F, 0.2F, 0.5F, 0.9F}) {
            for (const float b : {0.02F, 0.2F, 0.5F, 0.9F}) {
                const glm::vec3 wanted = skin_density({r, g, b});
                const auto cost_at = [&](glm::vec2 uv) {
                    const glm::vec3 e = weights * (skin_density(table().colour_linear_at(uv)) - wanted);
                    return glm::dot(e, e);
                };
                float least = std::numeric_limits<float>::infinity();
                for (float j = 0; j <= 64; ++j) {
                    for (float i = 0; i <= 64; ++i) least = std::min(least, cost_at({i / 64, j / 64}));
                }
                const SkinReading found = inverter.read({r, g, b});
                const float cost =
                    cost_at({table_coordinate(found.melanin, 0.5), table_coordinate(found.hemoglobin, 0.32)});
                EXPECT_LE(std::sqrt(cost), std::sqrt(least) + 0.005F) << r << " " << g << " " << b;
            }
        }
    }
}

TEST(SkinInversion, AnyColourGivesFiniteNumbers) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    const SkinInverter inverter(table(), glm::vec3(1), 0.35F);
    for (const glm::vec3 colour : {glm::vec3(0), glm::vec3(nan), glm::vec3(infinity), glm::vec3(-1), glm::vec3(1e30F),
                                   glm::vec3(0, 1, 0), glm::vec3(1e-30F, 0, 5)}) {
        const SkinReading reading = inverter.read(colour);
        EXPECT_TRUE(std::isfinite(reading.melanin) && std::isfinite(reading.hemoglobin));
        EXPECT_TRUE(std::isfinite(reading.shading) && std::isfinite(reading.chroma_error));
    }
}

/// A face of the table's own making: blotches of blood and melanin, light from one side, a camera's white.
ColourMap painted(std::uint32_t side, const glm::vec3& white, float light_step) {
    ColourMap map(side, side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const float u = static_cast<float>(x) / static_cast<float>(side),
                        v = static_cast<float>(y) / static_cast<float>(side);
            const float light = 1 - light_step * u;
            map.at(x, y) = white * light *
                           table().colour_linear(0.02F + 0.01F * v, 0.02F + 0.012F * std::sin(9 * u) * std::cos(7 * v));
        }
    }
    return map;
}

TEST(Appearance, RecomposesTheTextureExactly) {
    const ColourMap albedo = painted(32, {1.3F, 1.2F, 1.1F}, 0.3F);
    const AppearanceMaps maps = appearance_from_albedo(albedo, table());
    const ColourMap again = recomposed(maps, table());
    for (std::size_t i = 0; i < albedo.values.size(); ++i) {
        for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(again.values[i][c], albedo.values[i][c], 1e-5F);
    }
}

TEST(Appearance, ReadsBloodThroughLightAndWhite) {
    // The level is a guess, but where there is more blood the map has more, whatever the light does.
    const ColourMap albedo = painted(32, {1.3F, 1.2F, 1.1F}, 0.3F);
    AlbedoOptions options;
    options.typical_melanin = 0.025F;
    options.typical_hemoglobin = 0.02F;
    AlbedoReport report;
    const AppearanceMaps maps = appearance_from_albedo(albedo, table(), options, nullptr, &report);
    double both = 0, read2 = 0, true2 = 0, mean_read = 0, mean_true = 0;
    const auto truth = [](std::uint32_t x, std::uint32_t y) {
        return 0.02 + 0.012 * std::sin(9 * x / 32.0) * std::cos(7 * y / 32.0);
    };
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            mean_read += static_cast<double>(maps.hemoglobin.at(x, y)) / 1024;
            mean_true += truth(x, y) / 1024;
        }
    }
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            const double r = static_cast<double>(maps.hemoglobin.at(x, y)) - mean_read, t = truth(x, y) - mean_true;
            both += r * t;
            read2 += r * r;
            true2 += t * t;
        }
    }
    EXPECT_GT(both / std::sqrt(read2 * true2), 0.95);
    EXPECT_NEAR(report.typical_melanin, 0.025F, 1e-4F);
    EXPECT_GT(report.skin_share, 0.99);
    EXPECT_LT(report.median_difference, 1);
}

TEST(Appearance, EyesAndHairAreNotSkin) {
    ColourMap albedo = painted(32, glm::vec3(1.2F), 0);
    for (std::uint32_t x = 0; x < 32; ++x) {
        albedo.at(x, 0) = {0.75F, 0.77F, 0.8F};     // white of an eye
        albedo.at(x, 1) = {0.01F, 0.007F, 0.005F};  // dark hair
        albedo.at(x, 2) = {0.05F, 0.1F, 0.4F};      // blue iris
        albedo.at(x, 3) = glm::vec3(std::nanf(""));
    }
    const AppearanceMaps maps = appearance_from_albedo(albedo, table());
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            if (y < 4) {
                EXPECT_LT(maps.skin.at(x, y), 0.05F) << x << " " << y;
            } else {
                EXPECT_GT(maps.skin.at(x, y), 0.95F) << x << " " << y;
            }
        }
    }
}

TEST(Appearance, HardTexturesStayFinite) {
    const ColourMap grey(4, 3, glm::vec3(0.4F)), black(1, 1, glm::vec3(0)), nan(2, 2, glm::vec3(std::nanf("")));
    for (const ColourMap& albedo : {grey, black, nan}) {
        AlbedoReport report;
        const AppearanceMaps maps = appearance_from_albedo(albedo, table(), {}, nullptr, &report);
        EXPECT_LT(report.skin_share, 0.2);
        for (std::size_t i = 0; i < albedo.values.size(); ++i) {
            EXPECT_TRUE(std::isfinite(maps.melanin.values[i]) && std::isfinite(maps.hemoglobin.values[i]));
            EXPECT_FALSE(glm::any(glm::isnan(maps.residual.values[i])));
        }
    }
}

TEST(Appearance, CoverageKeepsSkinToTheFace) {
    const ColourMap albedo = painted(8, glm::vec3(1), 0);
    ScalarMap coverage(8, 8, 0);
    coverage.at(3, 4) = 1;
    const AppearanceMaps maps = appearance_from_albedo(albedo, table(), {}, &coverage);
    for (std::size_t i = 0; i < 64; ++i) {
        if (i != 4 * 8 + 3) {
            EXPECT_EQ(maps.skin.values[i], 0);
        }
    }
    EXPECT_GT(maps.skin.at(3, 4), 0.9F);
}

TEST(Appearance, TypicalSkinIsLookedForInItsRegion) {
    // A pale half and a dark one: either is typical, by where one looks.
    ColourMap albedo(16, 16, table().colour_linear(0.015F, 0.015F));
    for (std::size_t i = 0; i < 128; ++i) albedo.values[i] = table().colour_linear(0.15F, 0.015F);
    ScalarMap top(2, 2), bottom(2, 2);
    top.at(0, 0) = top.at(1, 0) = bottom.at(0, 1) = bottom.at(1, 1) = 1;
    AlbedoOptions options;
    AlbedoReport report;
    options.typical_region = &top;
    appearance_from_albedo(albedo, table(), options, nullptr, &report);
    EXPECT_NEAR(report.typical_melanin, 0.15F, 0.02F);
    options.typical_region = &bottom;
    appearance_from_albedo(albedo, table(), options, nullptr, &report);
    EXPECT_NEAR(report.typical_melanin, 0.015F, 0.003F);
}

TEST(Appearance, StoredBytesAreTheTablesAxis) {
    EXPECT_EQ(stored_byte(0, largest_melanin), 0);
    EXPECT_EQ(stored_byte(0.5F, largest_melanin), 255);
    EXPECT_EQ(stored_byte(std::nanf(""), largest_melanin), 0);
    for (int i = 0; i < 256; ++i) {
        const auto byte = static_cast<std::uint8_t>(i);
        EXPECT_EQ(stored_byte(stored_fraction(byte, largest_hemoglobin), largest_hemoglobin), byte);
    }
}

}  // namespace
}  // namespace blush
