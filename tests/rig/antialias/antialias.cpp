// MLAA and SMAA 1x on the CPU: laws, and how near they come to the true coverage.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "rig/antialias/blend.h"
#include "rig/antialias/coverage.h"
#include "rig/antialias/edges.h"
#include "rig/antialias/weights.h"
#include "tests/antialias_pictures.h"

namespace blush {
namespace {

constexpr PictureMeaning linear{.transfer = Transfer::linear};

double worst_difference(const Pixels& a, const Pixels& b) {
    EXPECT_EQ(a.cells.size(), b.cells.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.cells.size(); ++i) {
        const glm::vec4 difference = glm::abs(a.cells[i] - b.cells[i]);
        for (glm::length_t c = 0; c < 4; ++c) worst = std::max(worst, static_cast<double>(difference[c]));
    }
    return worst;
}

bool same_bits(const Pixels& a, const Pixels& b) {
    return std::ranges::equal(a.cells, b.cells, [](const glm::vec4& one, const glm::vec4& other) {
        for (glm::length_t c = 0; c < 4; ++c) {
            if (std::bit_cast<std::uint32_t>(one[c]) != std::bit_cast<std::uint32_t>(other[c])) return false;
        }
        return true;
    });
}

TEST(Antialias, AConstantPictureKeepsItsBits) {
    for (const glm::vec4& color : {glm::vec4(0.1F, 0.7F, 0.3F, 1), glm::vec4(0), glm::vec4(-3, 7e4F, 1e-20F, 0.5F)}) {
        for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(17, 13)}) {
            const Pixels picture(size.x, size.y, color);
            EXPECT_TRUE(same_bits(smaa(picture, {}, smaa_preset(SmaaPreset::ultra), {}), picture));
            EXPECT_TRUE(same_bits(mlaa(picture, {}, {}, linear), picture));
        }
    }
}

TEST(Antialias, WithoutContrastAboveTheThresholdNothingChanges) {
    const Pixels faint =
        test::painted(20, 20, [](int x, int y) { return glm::vec4(glm::vec3(x > y ? 0.5F : 0.58F), 1); });
    EXPECT_TRUE(same_bits(smaa(faint, {}, smaa_preset(SmaaPreset::high), {}), faint));
    EXPECT_FALSE(same_bits(smaa(faint, {}, smaa_preset(SmaaPreset::ultra), {}), faint));
}

TEST(Antialias, ATurnedPictureGivesATurnedResult) {
    // Eq. 10.1 asks for the contrast around one of the two pixels of an edge, so it prefers a side where contrasts
    // differ; without it, or in black and white, the filters know no direction.
    // An area halfway between two bytes may be rounded either way as the sums of its mirror image are ordered.
    constexpr double byte = 1 / 255.0;
    SmaaSettings anywhere = smaa_preset(SmaaPreset::high);
    anywhere.edges.contrast_factor = 0;
    for (const test::NamedPicture& picture : test::antialias_pictures()) {
        SCOPED_TRACE(picture.name);
        const Pixels filtered = smaa(picture.pixels, {}, anywhere, linear), old = mlaa(picture.pixels, {}, {}, linear);
        for (const unsigned way : {1U, 2U, 4U, 7U}) {
            const Pixels turned = test::turned(picture.pixels, way);
            EXPECT_LE(worst_difference(smaa(turned, {}, anywhere, linear), test::turned(filtered, way)), byte) << way;
            EXPECT_LE(worst_difference(mlaa(turned, {}, {}, linear), test::turned(old, way)), byte) << way;
        }
    }
}

TEST(Antialias, LocalContrastMasksFaintEdges) {
    // A strong edge with a faint one across it (figure 10.5): the faint one would cut the line in two.
    const Pixels picture = test::painted(16, 8, [](int x, int y) {
        return glm::vec4(glm::vec3(y < 4 ? 0.0F : x < 8 ? 0.8F : 0.95F), 1);
    });
    EdgeSettings settings;
    const EdgeMap adapted = find_edges(picture, {}, settings, {});
    settings.contrast_factor = 0;
    const EdgeMap all = find_edges(picture, {}, settings, {});
    EXPECT_TRUE(all.left(8, 4));
    EXPECT_FALSE(adapted.left(8, 4));  // beside the strong edge
    EXPECT_TRUE(adapted.left(8, 6));   // away from it
    EXPECT_TRUE(adapted.upper(8, 4));
}

TEST(Antialias, ColorsOfOneLumaHaveEdgesOfColorAlone) {
    const Pixels picture = test::text_picture({0.8F, 0.2F, 0.2F, 1}, {0.2F, 0.3784F, 0.2F, 1});
    EdgeSettings settings;
    const auto count = [&] {
        std::size_t found = 0;
        for (const glm::u8vec2 edge : find_edges(picture, {}, settings, {}).cells)
            found += std::size_t{edge.x} + edge.y;
        return found;
    };
    EXPECT_EQ(count(), 0U);
    settings.source = EdgeSource::color;
    EXPECT_GT(count(), 100U);
}

TEST(Antialias, DepthEdgesAndPredicationFollowTheDepth) {
    const Pixels picture = test::painted(
        16, 16, [](int x, int y) { return glm::vec4(glm::vec3((x < 8 ? 0.0F : 0.1F) + (y < 8 ? 0.0F : 0.15F)), 1); });
    DepthPixels depth(16, 16);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 16; ++x) depth.at(x, y) = x < 8 ? 0.3F : 0.6F;
    }
    EdgeSettings settings;
    settings.source = EdgeSource::depth;
    const EdgeMap silhouettes = find_edges(picture, depth, settings, {});
    EXPECT_TRUE(silhouettes.left(8, 3));
    EXPECT_FALSE(silhouettes.upper(3, 8));
    settings.source = EdgeSource::luma;
    settings.threshold = 0.08F;  // 0.096 at the silhouette, 0.16 elsewhere
    settings.predication.on = true;
    const EdgeMap predicated = find_edges(picture, depth, settings, {});
    EXPECT_TRUE(predicated.left(8, 3));
    EXPECT_FALSE(predicated.upper(3, 8));
    settings.predication.on = false;
    EXPECT_TRUE(find_edges(picture, depth, settings, {}).upper(3, 8));
}

TEST(Antialias, SearchesStopAtCrossingEdges) {
    // Figure 10.9: MLAA runs along the whole edge, SMAA stops where another one crosses.
    EdgeMap edges(24, 8);
    for (int x = 2; x < 22; ++x) edges.at(x, 4).y = 1;
    edges.at(8, 4).x = 1;  // crosses below, inside the line
    edges.at(15, 3).x = 1;
    const WeightMap weights = smaa_weights(edges, smaa_preset(SmaaPreset::medium));
    // Between the two a Z of seven pixels: below at the left end, above at the right.
    EXPECT_EQ(weights.at(8, 4).x, std::lround(255 * (0.5 - 0.5 / 7)));
    EXPECT_EQ(weights.at(14, 4).y, std::lround(255 * (0.5 - 0.5 / 7)));
    EXPECT_EQ(mlaa_weights(edges, {}).at(11, 4), glm::u8vec4(0));
}

TEST(Antialias, ABoxKeepsItsCornersWithoutRounding) {
    const Pixels box = test::painted(30, 24, [](int x, int y) {
        return glm::vec4(glm::vec3(x >= 6 && x < 23 && y >= 5 && y < 19 ? 1.0F : 0.0F), 1);
    });
    SmaaSettings settings = smaa_preset(SmaaPreset::high);
    settings.corner_rounding = 0;
    EXPECT_TRUE(same_bits(smaa(box, {}, settings, linear), box));
    settings.corner_rounding = 0.25F;
    const double quarter = worst_difference(smaa(box, {}, settings, linear), box);
    settings.corner_rounding = 1;
    const double whole = worst_difference(smaa(box, {}, settings, linear), box);
    EXPECT_NEAR(quarter, whole / 4, 1 / 255.0);
    EXPECT_GT(whole, 0.2);
}

TEST(Antialias, ADiagonalIsEvenAllAlong) {
    // The staircase of 45 degrees: every pixel of it gets the same, an eighth.
    const Pixels stairs =
        test::painted(40, 40, [](int x, int y) { return glm::vec4(glm::vec3(x + y >= 39 ? 1.0F : 0.0F), 1); });
    const Pixels filtered = smaa(stairs, {}, smaa_preset(SmaaPreset::high), linear);
    for (int x = 12; x < 28; ++x) {
        EXPECT_NEAR(filtered.at(x, 39 - x).x, 1 - 0.125, 1 / 255.0);
        EXPECT_NEAR(filtered.at(x, 38 - x).x, 0.125, 1 / 255.0);
    }
}

TEST(Antialias, MixesInLinearLightByDefault) {
    const Pixels stairs = test::orthogonal_pattern(-1, 1, 4, 1);
    const WeightMap weights = smaa_weights(find_edges(stairs, {}, {}, {}), {});
    const Pixels light = blend_neighbors(stairs, weights, {});
    const Pixels numbers = blend_neighbors(stairs, weights, {.blend_in_linear_light = false});
    const Pixels coverage = blend_neighbors(stairs, weights, linear);
    EXPECT_TRUE(same_bits(numbers, coverage));
    bool mixed = false;
    for (std::size_t i = 0; i < light.cells.size(); ++i) {
        const float c = coverage.cells[i].x;
        const float expected = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
        EXPECT_NEAR(light.cells[i].x, expected, 1e-5F);
        mixed |= c > 0.1F && c < 0.9F;
    }
    EXPECT_TRUE(mixed);
}

TEST(Antialias, StraightAlphaIsMixedInProportionToCoverage) {
    // A green disk on transparent magenta: the magenta must not show, the disk's alpha must be smoothed.
    const auto inside = [](int x, int y) {
        return std::hypot(static_cast<float>(x) - 11.3F, static_cast<float>(y) - 11.8F) < 8;
    };
    const Pixels disk = test::painted(
        24, 24, [&](int x, int y) { return inside(x, y) ? glm::vec4(0, 0.5F, 0, 1) : glm::vec4(1, 0, 1, 0); });
    const Pixels filtered = smaa(disk, {}, {}, {.alpha = AlphaMeaning::straight});
    int partial = 0;
    for (const glm::vec4& texel : filtered.cells) {
        if (texel.w <= 0 || texel.w >= 1) continue;
        ++partial;
        EXPECT_NEAR(texel.x, 0, 1e-6F);
        EXPECT_NEAR(texel.y, 128 / 255.0F, 1e-5F);
    }
    EXPECT_GT(partial, 20);
    // A black one has an edge of coverage alone.
    const Pixels black = test::painted(24, 24, [&](int x, int y) { return glm::vec4(0, 0, 0, inside(x, y) ? 1 : 0); });
    EXPECT_FALSE(same_bits(smaa(black, {}, {}, {.alpha = AlphaMeaning::straight}), black));
    EXPECT_TRUE(same_bits(smaa(black, {}, {}, {}), black));
}

TEST(Antialias, WhatIsNotFiniteDoesNotSpread) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity, 3e38F, -3e38F}) {
        Pixels picture = test::noise_picture(24, 24, 9, 2, true);
        for (int k = 0; k < 24; k += 5) picture.at(k, (7 * k) % 24) = glm::vec4(bad);
        for (const Pixels& filtered :
             {smaa(picture, {}, {}, {}), smaa(picture, {}, {}, linear), mlaa(picture, {}, {}, linear)}) {
            for (std::size_t i = 0; i < filtered.cells.size(); ++i) {
                for (glm::length_t c = 0; c < 4; ++c) {
                    const bool kept = std::bit_cast<std::uint32_t>(filtered.cells[i][c]) ==
                                      std::bit_cast<std::uint32_t>(picture.cells[i][c]);
                    EXPECT_TRUE(kept || std::isfinite(filtered.cells[i][c])) << bad;
                }
            }
        }
        const Pixels all(9, 9, glm::vec4(bad));
        EXPECT_TRUE(same_bits(smaa(all, {}, {}, {}), all)) << bad;
    }
}

// --- the oracle of coverage

TEST(Coverage, IsExact) {
    for (const CoverageShape& shape : coverage_shapes({.degrees = 15, .offsets = 2})) {
        const Grid<double> truth = exact_coverage(shape), fine = supersampled(shape, 4);
        double area = 0, apart = 0;
        for (std::size_t i = 0; i < truth.cells.size(); ++i) {
            EXPECT_GE(truth.cells[i], 0);
            EXPECT_LE(truth.cells[i], 1 + 1e-9);
            area += truth.cells[i];
            apart = std::max(apart, std::abs(truth.cells[i] - fine.cells[i]));
        }
        double polygons = 0;
        for (const Polygon& polygon : shape.polygons) {
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                polygons += (a.x * b.y - a.y * b.x) / 2;
            }
        }
        EXPECT_NEAR(area, std::abs(polygons), 1e-6) << shape.family;
        EXPECT_LE(apart, 0.26) << shape.family;  // sixteen samples, one row or column of them astray
    }
}

struct Means {
    double none = 0, mlaa = 0, low = 0, high = 0, supersampled = 0;
};

Means means_of(std::string_view family, int first_degree, int last_degree) {
    CoverageError none, old, low, high, fine;
    const CoverageDensity density{.degrees = 3, .offsets = 2};
    const auto shapes = coverage_shapes(density);
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const int degrees = static_cast<int>(s) / (4 * density.offsets) * density.degrees;
        if (shapes[s].family != family || degrees < first_degree || degrees > last_degree) continue;
        const Grid<double> truth = exact_coverage(shapes[s]);
        const Pixels picture = sampled(shapes[s]);
        none.add(coverage_error(shown_coverage(picture), truth));
        old.add(coverage_error(shown_coverage(mlaa(picture, {}, {}, linear)), truth));
        low.add(coverage_error(shown_coverage(smaa(picture, {}, smaa_preset(SmaaPreset::low), linear)), truth));
        high.add(coverage_error(shown_coverage(smaa(picture, {}, smaa_preset(SmaaPreset::high), linear)), truth));
        fine.add(coverage_error(supersampled(shapes[s], 8), truth));
    }
    return {none.mean(), old.mean(), low.mean(), high.mean(), fine.mean()};
}

TEST(Coverage, SmaaIsNearerThanMlaaOnDiagonals) {
    const Means means = means_of("half planes", 36, 54);
    EXPECT_LT(means.high, 0.6 * means.mlaa);
    EXPECT_LT(means.mlaa, means.none);
    EXPECT_LT(means.supersampled, means.high);
}

TEST(Coverage, SmaaIsNearerThanMlaaOnCorners) {
    for (const char* family : {"corners", "wedges", "thin lines"}) {
        const Means means = means_of(family, 0, 90);
        EXPECT_LT(means.high, means.mlaa) << family;
        EXPECT_LT(means.mlaa, means.none) << family;
        EXPECT_LE(means.high, means.low) << family;
        EXPECT_LT(means.supersampled, means.high) << family;
    }
}

}  // namespace
}  // namespace blush
