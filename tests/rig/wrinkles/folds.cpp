// Folds: their spacing and direction are those that were asked for.

#include "rig/wrinkles/folds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

std::vector<glm::vec2> uniform(glm::vec2 wave) { return std::vector<glm::vec2>(side * side, wave); }

/// Power of the map at a wave vector (cycles a texel).
double power_at(const std::vector<float>& map, glm::dvec2 wave) {
    double real = 0, imaginary = 0;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double phase = 2 * 3.14159265358979 * (wave.x * (i % side) + wave.y * static_cast<double>(i / side));
        real += static_cast<double>(map[i]) * std::cos(phase);
        imaginary += static_cast<double>(map[i]) * std::sin(phase);
    }
    return real * real + imaginary * imaginary;
}

TEST(Folds, HaveTheSpacingAndDirectionAskedFor) {
    for (const double degrees : {0.0, 30.0, 90.0, 135.0}) {
        constexpr double cycles = 1.0 / 8;
        const auto wave = [&](double angle, double length) {
            return glm::dvec2(std::cos(glm::radians(angle)), std::sin(glm::radians(angle))) * length;
        };
        const std::vector<float> folds = grow_folds(uniform(glm::vec2(wave(degrees, cycles))), side, side, 1);
        // The bin of the wave and its neighbours (a pattern of finite patches is spread a little) hold most of it.
        double near = 0, all = 0;
        for (int y = -16; y <= 16; ++y) {
            for (int x = -16; x <= 16; ++x) {
                const glm::dvec2 at = glm::dvec2(x, y) / 64.0;
                const double power = power_at(folds, at);
                all += power;
                const glm::dvec2 want = wave(degrees, cycles);
                if (std::min(glm::distance(at, want), glm::distance(at, -want)) < 0.05) near += power;
            }
        }
        EXPECT_GT(near / all, 0.8) << degrees;
    }
}

TEST(Folds, ReachRidgeAndValley) {
    const std::vector<float> folds = grow_folds(uniform({0.1F, 0}), side, side, 3);
    const auto [low, high] = std::ranges::minmax(folds);
    EXPECT_GT(high, 0.7F);
    EXPECT_LT(low, -0.7F);
    EXPECT_LE(high, 1);
    EXPECT_GE(low, -1);
}

TEST(Folds, StayOutOfWhereNothingIsPressed) {
    std::vector<glm::vec2> wave = uniform({0.125F, 0});
    for (std::size_t i = 0; i < wave.size() / 2; ++i) wave[i] = {0, 0};
    wave.back() = {std::nanf(""), 0};
    const std::vector<float> folds = grow_folds(wave, side, side, 1);
    for (std::size_t i = 0; i < wave.size() / 2; ++i) ASSERT_EQ(folds[i], 0);
    EXPECT_EQ(folds.back(), 0);
}

TEST(Folds, SameSeedSameBitsOtherSeedOtherFolds) {
    const auto wave = uniform({0, 0.15F});
    EXPECT_EQ(grow_folds(wave, side, side, 1), grow_folds(wave, side, side, 1));
    EXPECT_NE(grow_folds(wave, side, side, 1), grow_folds(wave, side, side, 2));
    EXPECT_TRUE(grow_folds({}, 0, 0, 1).empty());
}

}  // namespace
}  // namespace blush
