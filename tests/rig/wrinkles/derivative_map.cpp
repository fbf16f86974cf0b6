// Normal maps as partial derivatives: laws, and what storage does to them.

#include "rig/wrinkles/derivative_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush {
namespace {

glm::vec3 tilted(double degrees, double around_degrees) {
    const double tilt = glm::radians(degrees), around = glm::radians(around_degrees);
    return {static_cast<float>(std::sin(tilt) * std::cos(around)),
            static_cast<float>(std::sin(tilt) * std::sin(around)), static_cast<float>(std::cos(tilt))};
}

double angle_degrees(glm::vec3 a, glm::vec3 b) {
    return glm::degrees(
        std::atan2(static_cast<double>(glm::length(glm::cross(a, b))), static_cast<double>(glm::dot(a, b))));
}

TEST(DerivativeMap, FlatIsTheGeometricNormalToTheBit) {
    EXPECT_EQ(normal_from_derivative(glm::vec2(0)), glm::vec3(0, 0, 1));
    EXPECT_EQ(derivative_from_normal({0, 0, 1}, 1), glm::vec2(0));
    EXPECT_EQ(derivative_from_stored(stored_derivative(0, 1), 1), 0.0F);
}

TEST(DerivativeMap, ThereAndBackWithinTheRange) {
    for (int around = 0; around < 360; around += 30) {
        for (int tilt = 0; tilt <= 75; tilt += 5) {
            const glm::vec3 n = tilted(tilt, around);
            EXPECT_LT(angle_degrees(normal_from_derivative(derivative_from_normal(n, 4)), n), 1e-4) << tilt;
        }
    }
}

TEST(DerivativeMap, SignIsAsPrintedWithoutAMinus) {
    const glm::vec2 derivative = derivative_from_normal({0.6F, 0, 0.8F}, 1);
    EXPECT_FLOAT_EQ(derivative.x, 0.75F);
    EXPECT_GT(normal_from_derivative({0.5F, 0}).x, 0);
}

TEST(DerivativeMap, SumsOfDerivativesAreSumsOfHeights) {
    constexpr std::uint32_t side = 24;
    std::vector<float> first, second, both;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const auto x = static_cast<float>(i % side), y = static_cast<float>(i / side);
        first.push_back(0.3F * std::sin(x / 3));
        second.push_back(0.2F * std::cos(x / 5 + y / 4));
        both.push_back(first.back() + second.back());
    }
    const auto a = derivatives_from_heights(first, side, side, glm::vec2(1));
    const auto b = derivatives_from_heights(second, side, side, glm::vec2(1));
    const auto sum = derivatives_from_heights(both, side, side, glm::vec2(1));
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
        EXPECT_NEAR(glm::distance(a.values[i] + b.values[i], sum.values[i]), 0, 1e-6F);
    }
}

TEST(DerivativeMap, APlaneOfKnownSlopeHasItsNormal) {
    constexpr std::uint32_t side = 5;
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < side * side; ++i)
        heights.push_back(0.25F * static_cast<float>(i % side) - 0.5F * static_cast<float>(i / side));
    const auto map = derivatives_from_heights(heights, side, side, glm::vec2(0.5F, 2));
    for (const glm::vec2 texel : map.values) {
        EXPECT_FLOAT_EQ(texel.x, -0.5F);
        EXPECT_FLOAT_EQ(texel.y, 0.25F);
    }
}

// Beyond 45 degrees one component saturates at range 1 (8.2.1): the direction around the normal is kept where the
// larger component is cut, and the tilt ends at 45 degrees along an axis. A range of 4 reaches 76 degrees.
TEST(DerivativeMap, BeyondTheRangeTheTiltEndsThere) {
    for (const double tilt : {50.0, 70.0, 89.0}) {
        const glm::vec3 n = tilted(tilt, 0);
        EXPECT_NEAR(angle_degrees(normal_from_derivative(derivative_from_normal(n, 1)), {0, 0, 1}), 45, 1e-3);
    }
    EXPECT_NEAR(angle_degrees(normal_from_derivative(derivative_from_normal(tilted(70, 0), 4)), {0, 0, 1}), 70, 1e-3);
    EXPECT_NEAR(angle_degrees(normal_from_derivative(derivative_from_normal(tilted(89, 0), 4)), {0, 0, 1}), 75.96,
                0.01);
    double saturated = 0;
    NormalMap two(2, 1);
    two.values = {tilted(50, 0), tilted(40, 0)};
    derivatives_from_normals(two, 1, &saturated);
    EXPECT_EQ(saturated, 0.5);
}

TEST(DerivativeMap, DirectionsThatAreNoSurfaceBecomeFlatOrSteepest) {
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(derivative_from_normal({0, 0, 0}, 1), glm::vec2(0));
    EXPECT_EQ(derivative_from_normal({0, 0, -1}, 1), glm::vec2(0));
    EXPECT_EQ(derivative_from_normal({nan, 0, 1}, 1), glm::vec2(0));
    EXPECT_EQ(derivative_from_normal({infinity, 0, 1}, 1), glm::vec2(0));
    EXPECT_EQ(derivative_from_normal({1, 0.5F, 0}, 1), glm::vec2(1, 0.5F));
    EXPECT_EQ(derivative_from_normal({0, 1, -0.5F}, 2), glm::vec2(0, 2));
    EXPECT_EQ(stored_derivative(nan, 1), 0);
    EXPECT_EQ(stored_derivative(9, 1), 127);
    EXPECT_EQ(stored_derivative(-9, 1), -127);
}

// Half a step of 8 bits over the range: 0.23 degrees at range 1 near flat.
TEST(DerivativeMap, EightBitsAreWithinHalfAStep) {
    for (const float range : {1.0F, 2.0F, 4.0F}) {
        for (int i = -100; i <= 100; ++i) {
            const float derivative = static_cast<float>(i) / 100 * range;
            const float back = derivative_from_stored(stored_derivative(derivative, range), range);
            EXPECT_NEAR(back, derivative, range / 254 * 1.0001F);
        }
    }
}

TEST(NormalDifference, FullWeightIsTheWrinkledNormalAndNoneIsTheBase) {
    const glm::vec3 base = tilted(10, 40), wrinkled = tilted(35, 200);
    const glm::vec3 difference = normal_difference(wrinkled, base);
    EXPECT_LT(angle_degrees(add_normal_difference(base, difference, 1), wrinkled), 1e-4);
    EXPECT_LT(angle_degrees(add_normal_difference(base, difference, 0), base), 1e-4);
    EXPECT_EQ(add_normal_difference(base, -base, 1), base);
}

}  // namespace
}  // namespace blush
