#include "rig/blood/hemoglobin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_colour_table.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

/// Vessels: noise of a few sizes about `level`, never below a tenth of it.
ScalarMap vessels(std::uint32_t width, std::uint32_t height, float level, std::uint64_t seed) {
    test::Random random(seed);
    ScalarMap map(width, height, level);
    for (std::uint32_t size : {1U, 3U, 7U}) {
        ScalarMap noise(width / size + 2, height / size + 2);
        for (float& value : noise.values) value = random.between(-0.3F, 0.3F) * level;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                map.at(x, y) += sample(noise, (glm::vec2(x, y) + 0.5F) /
                                                  (static_cast<float>(size) * glm::vec2(noise.width, noise.height)));
            }
        }
    }
    for (float& value : map.values) value = std::max(value, 0.1F * level);
    return map;
}

void expect_near(const ScalarMap& a, const ScalarMap& b, float tolerance) {
    ASSERT_TRUE(a.same_size(b));
    for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], tolerance) << i;
}

TEST(LocalStatistics, FastAgreesWithTheDefinition) {
    const ScalarMap map = vessels(23, 17, 0.03F, 5);
    ScalarMap weights(23, 17, 1);
    for (std::size_t i = 0; i < weights.values.size(); i += 3) weights.values[i] = static_cast<float>(i % 5) / 4;
    for (const float radius : {0.0F, 0.5F, 1.0F, 1.5F, 4.0F, 9.3F, 22.0F, 1000.0F}) {
        for (const ScalarMap* w : {static_cast<const ScalarMap*>(nullptr), static_cast<const ScalarMap*>(&weights)}) {
            const LocalStatistics fast = local_statistics(map, radius, w);
            const LocalStatistics slow = local_statistics_by_definition(map, radius, w);
            // Sums in double precision, results in float: a few units in the last place of 0.03.
            expect_near(fast.mean, slow.mean, 1e-8F);
            expect_near(fast.deviation, slow.deviation, 1e-7F);
        }
    }
}

TEST(LocalStatistics, RadiusOfZeroIsTheMapItself) {
    const ScalarMap map = vessels(9, 5, 0.03F, 1);
    for (const float radius : {0.0F, -3.0F, std::nanf("")}) {
        const LocalStatistics s = local_statistics(map, radius);
        expect_near(s.mean, map, 1e-9F);
        expect_near(s.deviation, ScalarMap(9, 5), 1e-9F);
    }
}

TEST(LocalStatistics, RadiusWiderThanTheMapIsTheWholeMap) {
    const ScalarMap map = vessels(9, 5, 0.03F, 1);
    const LocalStatistics s = local_statistics(map, std::numeric_limits<float>::infinity());
    for (const float mean : s.mean.values) EXPECT_NEAR(mean, s.mean.values[0], 1e-9F);
    for (const float deviation : s.deviation.values) EXPECT_NEAR(deviation, s.deviation.values[0], 1e-8F);
    EXPECT_GT(s.deviation.values[0], 0.001F);
}

TEST(LocalStatistics, ConstantMapsHaveNoDeviationAtAll) {
    for (const float value : {0.0F, 0.1F, 1e-20F, 3e8F}) {
        const LocalStatistics s = local_statistics(ScalarMap(12, 7, value), 3.3F);
        for (const float mean : s.mean.values) EXPECT_EQ(mean, value);
        for (const float deviation : s.deviation.values) EXPECT_EQ(deviation, 0);
    }
}

TEST(LocalStatistics, WhatIsNotFiniteHasNoWeight) {
    ScalarMap map(6, 6, 0.02F);
    map.at(2, 3) = std::nanf("");
    map.at(0, 0) = std::numeric_limits<float>::infinity();
    const LocalStatistics s = local_statistics(map, 2);
    for (const float mean : s.mean.values) EXPECT_EQ(mean, 0.02F);
    const LocalStatistics none = local_statistics(ScalarMap(2, 2, std::nanf("")), 1);
    for (const float mean : none.mean.values) EXPECT_EQ(mean, 0);
    const LocalStatistics one = local_statistics(ScalarMap(1, 1, 0.5F), 4);
    EXPECT_EQ(one.mean.values[0], 0.5F);
}

TEST(Hemoglobin, NeutralScaleAndBiasGiveBackTheMap) {
    const ScalarMap neutral = vessels(20, 20, 0.03F, 2);
    const LocalStatistics statistics = local_statistics(neutral, 4);
    const HemoglobinChange same = hemoglobin_change(statistics, statistics);
    const ScalarMap skin(20, 20, 1);
    const float weight = 1;
    expect_near(blended_hemoglobin(neutral, skin, std::span(&weight, 1), std::span(&same, 1)), neutral, 1e-8F);
}

TEST(Hemoglobin, ZeroWeightsGiveBackTheMapToTheBit) {
    const ScalarMap neutral = vessels(20, 20, 0.03F, 2), other = vessels(20, 20, 0.06F, 3), skin(20, 20, 1);
    const HemoglobinChange change = hemoglobin_change(local_statistics(neutral, 4), local_statistics(other, 4));
    const float weight = 0;
    EXPECT_EQ(blended_hemoglobin(neutral, skin, std::span(&weight, 1), std::span(&change, 1)).values, neutral.values);
    EXPECT_EQ(blended_hemoglobin(0.02F, std::span(&weight, 1), std::span(&weight, 1), std::span(&weight, 1)), 0.02F);
}

TEST(Hemoglobin, IsTheAffineCombinationOfTheThesis) {
    // 7.6 as printed, with its mean-free map and weights that sum to one, against ours.
    const ScalarMap neutral = vessels(16, 16, 0.03F, 2), a = vessels(16, 16, 0.05F, 3), b = vessels(16, 16, 0.02F, 4);
    const LocalStatistics n = local_statistics(neutral, 4), sa = local_statistics(a, 4), sb = local_statistics(b, 4);
    const HemoglobinChange changes[] = {hemoglobin_change(n, sa), hemoglobin_change(n, sb)};
    const float weights[] = {0.3F, 0.5F};
    const ScalarMap blended = blended_hemoglobin(neutral, ScalarMap(16, 16, 1), weights, changes);
    for (std::size_t i = 0; i < 256; ++i) {
        const float mean_free = neutral.values[i] - n.mean.values[i];
        const float bias = 0.2F * n.mean.values[i] + 0.3F * sa.mean.values[i] + 0.5F * sb.mean.values[i];
        const float scale = 0.2F * 1 + 0.3F * sa.deviation.values[i] / n.deviation.values[i] +
                            0.5F * sb.deviation.values[i] / n.deviation.values[i];
        EXPECT_NEAR(blended.values[i], std::max(0.0F, bias + mean_free * scale), 1e-7F);
    }
}

TEST(Hemoglobin, ConstantMapsStayConstantAndFinite) {
    const ScalarMap neutral(10, 10, 0.03F), fuller(10, 10, 0.05F), skin(10, 10, 1);
    const HemoglobinChange change = hemoglobin_change(local_statistics(neutral, 3), local_statistics(fuller, 3));
    for (const float weight : {0.25F, 1.0F}) {
        const ScalarMap result = blended_hemoglobin(neutral, skin, std::span(&weight, 1), std::span(&change, 1));
        for (const float h : result.values) EXPECT_NEAR(h, 0.03F + weight * 0.02F, 1e-7F);
    }
    // A pattern on a flat map cannot be made out of nothing: its mean comes, its deviation does not.
    const ScalarMap rich = vessels(10, 10, 0.03F, 9);
    const HemoglobinChange from_flat = hemoglobin_change(local_statistics(neutral, 3), local_statistics(rich, 3));
    for (const float scale : from_flat.scale.values) EXPECT_EQ(scale, 1);
}

TEST(Hemoglobin, TheFactorIsOnTheWholeFace) {
    const float no_weights[] = {0};
    EXPECT_FLOAT_EQ(blended_hemoglobin(0.02F, no_weights, no_weights, no_weights, 1.27F), 0.0254F);
    const float weight[] = {1}, scale[] = {0.5F}, offset[] = {0.01F};
    EXPECT_FLOAT_EQ(blended_hemoglobin(0.02F, weight, scale, offset, 0.81F), 0.81F * 0.02F);
    EXPECT_EQ(blended_hemoglobin(0.3F, weight, scale, offset, 9), 0.32F);  // no more than the table's end
    EXPECT_EQ(blended_hemoglobin(0.02F, weight, scale, offset, std::nanf("")), 0);
}

TEST(Hemoglobin, WhatIsNotSkinKeepsItsBlood) {
    const ScalarMap neutral(4, 1, 0.03F);
    ScalarMap skin(4, 1, 1);
    skin.at(1, 0) = 0;
    skin.at(2, 0) = 0.5F;
    const HemoglobinChange change{ScalarMap(1, 1, 2), ScalarMap(1, 1, 0)};
    const float weight = 1;
    const ScalarMap result = blended_hemoglobin(neutral, skin, std::span(&weight, 1), std::span(&change, 1));
    EXPECT_FLOAT_EQ(result.at(0, 0), 0.06F);
    EXPECT_EQ(result.at(1, 0), 0.03F);
    EXPECT_FLOAT_EQ(result.at(2, 0), 0.045F);
}

TEST(Hemoglobin, TransferCarriesTheRelativeChange) {
    const RelativeChange change = relative_change(0.02F, 0.004F, 0.03F, 0.005F);
    EXPECT_FLOAT_EQ(change.mean, 0.5F);
    EXPECT_NEAR(change.deviation, 0.25F, 1e-6F);
    const HemoglobinTexel on_another = transferred(change, 0.04F);
    EXPECT_NEAR(on_another.scale, 1.25F, 1e-6F);
    EXPECT_FLOAT_EQ(on_another.scale * 0.04F + on_another.offset, 0.06F);
    const RelativeChange from_nothing = relative_change(0, 0, 0.03F, 0.005F);
    EXPECT_EQ(from_nothing.mean, 0);
    EXPECT_EQ(from_nothing.deviation, 0);
}

TEST(HistogramMatching, TakesTheTargetsDistribution) {
    const ScalarMap source = vessels(14, 14, 0.03F, 2), target = vessels(14, 14, 0.06F, 3);
    // With a disc over all, it is ordinary histogram matching: the values are the target's own.
    const ScalarMap matched = matched_locally(source, target, 100);
    std::vector<float> result = matched.values, wanted = target.values;
    std::ranges::sort(result);
    std::ranges::sort(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(result[i], wanted[i], 2e-4F);
    expect_near(matched_locally(source, source, 3), source, 1e-7F);
    expect_near(matched_locally(source, target, 0), target, 0);
}

// The approximation of 7.3 and the down-sampling, in what they are worth: CIEDE2000 of the skin's colour.
TEST(HistogramMatching, ScaleAndBiasComeNearIt) {
    constexpr std::uint32_t side = 48;
    constexpr float radius = 6;
    const ScalarMap source = vessels(side, side, 0.02F, 2), fuller = vessels(side, side, 0.028F, 3);
    ScalarMap target = source;  // an expression: other vessels, fuller towards the middle
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::vec2 off = (glm::vec2(x, y) - side / 2.0F) / (side / 4.0F);
            target.at(x, y) = glm::mix(source.at(x, y), fuller.at(x, y), std::exp(-glm::dot(off, off)));
        }
    }
    const ScalarMap exact = matched_locally(source, target, radius);
    const HemoglobinChange full = hemoglobin_change(local_statistics(source, radius), local_statistics(target, radius));
    const HemoglobinChange quarter{resized(full.scale, side / 4, side / 4), resized(full.offset, side / 4, side / 4)};
    const float weight = 1;
    const ScalarMap skin(side, side, 1);
    const SkinColourTable table(32, 32);
    const auto mean_error = [&](const ScalarMap& a, const ScalarMap& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            sum += ciede2000_of_srgb_linear(glm::dvec3(table.colour_linear(0.02F, a.values[i])),
                                            glm::dvec3(table.colour_linear(0.02F, b.values[i])));
        }
        return sum / static_cast<double>(a.values.size());
    };
    const ScalarMap by_scale = blended_hemoglobin(source, skin, std::span(&weight, 1), std::span(&full, 1));
    const ScalarMap by_coarse = blended_hemoglobin(source, skin, std::span(&weight, 1), std::span(&quarter, 1));
    const double change = mean_error(source, exact), approximation = mean_error(by_scale, exact);
    const double sampling = mean_error(by_coarse, by_scale);
    RecordProperty("change", std::to_string(change));
    RecordProperty("approximation", std::to_string(approximation));
    RecordProperty("sampling", std::to_string(sampling));
    EXPECT_GT(change, 0.5);
    EXPECT_LT(approximation, 0.3 * change);
    EXPECT_LT(sampling, 0.2 * change);
}

}  // namespace
}  // namespace blush
