// Laws of the camera's effects, on their twins in double precision.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "rig/camera/bloom.h"
#include "rig/camera/depth_of_field.h"
#include "rig/camera/exposure.h"
#include "rig/camera/film_grain.h"

namespace blush {
namespace {

using Picture = Map<glm::dvec3>;

glm::dvec3 sum(const Picture& picture) {
    return std::accumulate(picture.values.begin(), picture.values.end(), glm::dvec3(0));
}

TEST(Bloom, KeepsAConstantImageAndTheTotalOfALightInTheMiddle) {
    const Picture constant(37, 23, glm::dvec3(0.3, 2, 11));
    for (const glm::dvec3& c : bloomed(constant, 0.4, 0.5, 4).values) {
        EXPECT_NEAR(glm::length(c - glm::dvec3(0.3, 2, 11)), 0, 1e-12);
    }
    Picture light(64, 64, glm::dvec3(0));
    light.at(30, 33) = {5, 3, 1};
    light.at(32, 31) = {0.2, 0.9, 0.4};
    for (const double threshold : {0.0, 0.5}) {
        const Picture spread = bloomed(light, 0.7, threshold, 3);
        EXPECT_NEAR(glm::length(sum(spread) - sum(light)), 0, 1e-12);
        EXPECT_LT(spread.at(30, 33).x, 3);
        EXPECT_GT(spread.at(24, 33).x, 0);
    }
}

TEST(Bloom, LeavesWhatIsBelowTheThresholdAndMendsWhatIsNoNumber) {
    Picture picture(16, 16, glm::dvec3(0.25));
    EXPECT_EQ(bloomed(picture, 1, 0.3, 2).values, picture.values);
    picture.at(3, 3) = glm::dvec3(std::nan(""));
    picture.at(9, 9) = glm::dvec3(INFINITY, 1, 1);
    for (const glm::dvec3& c : bloomed(picture, 0.1, 0, 3).values) {
        ASSERT_TRUE(std::isfinite(c.x + c.y + c.z));
        ASSERT_LE(c.x, 60000);
    }
}

TEST(Exposure, BringsAConstantImageToTheKeyWhateverItsFactor) {
    for (const double radiance : {0.01, 0.18, 3.0, 40.0}) {
        for (const Metering metering : {Metering::frame, Metering::centre}) {
            const double average = log2_average_luminance(Picture(9, 7, glm::dvec3(radiance)), metering);
            const double factor = std::exp2(log2_exposure(average, 0.18, 0, 16));
            EXPECT_NEAR(factor * radiance, 0.18, 0.18 * 1.1e-4 / radiance) << radiance;  // black counts as 1e-4
        }
    }
    EXPECT_EQ(log2_exposure(log2_average_luminance(Picture(4, 4, glm::dvec3(0)), Metering::frame), 0.18, 0, 5), 5);
    Picture broken(2, 1, glm::dvec3(0.18));
    broken.at(1, 0).y = std::nan("");
    EXPECT_NEAR(log2_average_luminance(broken, Metering::frame), std::log2(0.1801), 1e-9);
}

TEST(Exposure, AdaptsByHalfInAHalfLifeInAnyNumberOfSteps) {
    EXPECT_NEAR(adapted(0, 4, 0.5, 0.5), 2, 1e-12);
    EXPECT_NEAR(adapted(adapted(1, 4, 0.2, 0.5), 4, 0.3, 0.5), adapted(1, 4, 0.5, 0.5), 1e-12);
}

TEST(DepthOfField, RadiiFollowTheThinLens) {
    const ThinLens lens{.f_number = 2, .focal_length_mm = 80, .focus_mm = 1000, .sensor_height_mm = 24};
    const BlurRadius blur = blur_radius(lens, 480, 1e9);
    EXPECT_EQ(blur.at(1000), 0);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // c = A F |d - s| / (d (s - F)): A = 40 mm.
    const double behind_mm = 40.0 * 80 * 500 / (1500 * 920), before_mm = 40.0 * 80 * 300 / (700 * 920);
    EXPECT_NEAR(blur.at(1500), 0.5 * behind_mm / 24 * 480, 1e-9);
    EXPECT_NEAR(blur.at(700), -0.5 * before_mm / 24 * 480, 1e-9);
    EXPECT_NEAR(blur.at(infinity), 0.5 * 40.0 * 80 / 920 / 24 * 480, 1e-9);
    EXPECT_EQ(blur_radius(lens, 480, 7).at(infinity), 7);
    for (const double focus_mm : {1e-9, 80.0, 1e9}) {
        ThinLens hard = lens;
        hard.focus_mm = focus_mm;
        hard.f_number = 1e-3;
        for (const double depth_mm : {1e-3, 1.0, 1e12}) {
            EXPECT_TRUE(std::isfinite(blur_radius(hard, 480, 14).at(depth_mm)));
        }
    }
}

TEST(DepthOfField, WhatIsSharpStaysAndSharpThingsDoNotSpreadOverBlurredOnes) {
    Picture picture(40, 40, glm::dvec3(0.1));
    Map<float> radius(40, 40, 6.0F);
    for (std::uint32_t y = 0; y < 40; ++y) {
        for (std::uint32_t x = 0; x < 20; ++x) {
            picture.at(x, y) = {50, 0.1 * y, x};
            radius.at(x, y) = 0;
        }
    }
    const Picture blurred = defocused(picture, radius, blur_taps(81), 8);
    for (std::uint32_t y = 0; y < 40; ++y) {
        for (std::uint32_t x = 0; x < 40; ++x) {
            EXPECT_NEAR(glm::length(blurred.at(x, y) - picture.at(x, y)), 0, 1e-12) << x << ", " << y;
        }
    }
    const Picture sharp = defocused(picture, Map<float>(40, 40, 0.3F), blur_taps(49), 8);
    EXPECT_EQ(sharp.values, picture.values);
}

TEST(DepthOfField, WhatIsBlurredInFrontSpreadsOverWhatIsSharp) {
    Picture picture(40, 40, glm::dvec3(0));
    Map<float> radius(40, 40, 0.0F);
    for (std::uint32_t y = 0; y < 40; ++y) {
        for (std::uint32_t x = 0; x < 20; ++x) {
            picture.at(x, y) = glm::dvec3(1);
            radius.at(x, y) = -6;
        }
    }
    const Picture blurred = defocused(picture, radius, blur_taps(81), 8);
    EXPECT_NEAR(blurred.at(19, 20).x, 0.5, 0.1);
    EXPECT_GT(blurred.at(22, 20).x, 0.1);
    EXPECT_LT(blurred.at(22, 20).x, 0.4);
    EXPECT_EQ(blurred.at(28, 20).x, 0);
    EXPECT_NEAR(blurred.at(8, 20).x, 1, 1e-9);
}

TEST(FilmGrain, HasMeanNoughtAndVarianceOneAndStaysWithinItsReach) {
    for (const double size : {1.0, 1.7, 3.0}) {
        double mean = 0, square = 0, largest = 0;
        constexpr std::uint32_t side = 256;
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const double noise = film_grain_noise(x, y, 5, 3, size);
                mean += noise;
                square += noise * noise;
                largest = std::max(largest, std::abs(noise));
            }
        }
        mean /= side * side;
        square /= side * side;
        // Four deviations of a mean of as many independent values as there are grains.
        EXPECT_NEAR(mean, 0, 4 * size / side);
        EXPECT_NEAR(square, 1, 8 * size / side);
        EXPECT_LE(largest, film_grain_reach(size));
    }
    EXPECT_EQ(film_grain_noise(7, 9, 11, 2, 1), film_grain_noise(7, 9, 11, 2, 1));
    EXPECT_NE(film_grain_noise(7, 9, 11, 2, 1), film_grain_noise(7, 9, 12, 2, 1));
}

TEST(FilmGrain, DependsOnTheLuminanceAndNeverLeavesTheDisplay) {
    EXPECT_EQ(film_grain_deviation(0, 0.1, 1), 0);
    EXPECT_EQ(film_grain_deviation(1, 0.1, 1), 0);
    EXPECT_NEAR(film_grain_deviation(0.5, 0.1, 1), 0.1, 1e-12);
    EXPECT_NEAR(film_grain_deviation(0.8, 0.1, 1), 0.08, 1e-3);
    for (double value = 0; value <= 1; value += 0.01) {
        const double most = film_grain_deviation(value, 0.3, 2) * film_grain_reach(2);
        EXPECT_LE(value + most, 1 + 1e-12);
        EXPECT_GE(value - most, -1e-12);
    }
}

}  // namespace
}  // namespace blush
