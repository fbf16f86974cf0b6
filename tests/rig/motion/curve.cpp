#include "rig/motion/curve.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/rotation.h"

namespace blush {
namespace {

constexpr float nan_time = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

float value_at(const Track& track, float time) {
    float out = -99;
    sample(track, time, {&out, 1});
    return out;
}

Track scalar(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
    return {.interpolation = interpolation, .width = 1, .times_seconds = std::move(times), .values = std::move(values)};
}

TEST(Curve, StepHoldsUntilTheNextKey) {
    const Track track = scalar(Interpolation::step, {1, 2, 4}, {10, 20, 30});
    EXPECT_EQ(value_at(track, 1), 10);
    EXPECT_EQ(value_at(track, std::nextafter(2.0F, 0.0F)), 10);
    EXPECT_EQ(value_at(track, 2), 20);
    EXPECT_EQ(value_at(track, 3.9F), 20);
    EXPECT_EQ(value_at(track, 4), 30);
}

TEST(Curve, LinearIsTheStraightLine) {
    const Track track = scalar(Interpolation::linear, {1, 2, 4}, {10, 20, 0});
    EXPECT_EQ(value_at(track, 1.25F), 12.5F);
    EXPECT_EQ(value_at(track, 2), 20);
    EXPECT_EQ(value_at(track, 3.5F), 5);
}

TEST(Curve, CubicSplineFollowsTheFormula) {
    // Keys (in, value, out): (0, 1, 2) at 0 and (4, 3, 0) at 2. At u = 0.5:
    // 0.5 * 1 + 2 * 0.125 * 2 + 0.5 * 3 + 2 * -0.125 * 4 = 0.5 + 0.5 + 1.5 - 1 = 1.5.
    const Track track = scalar(Interpolation::cubic_spline, {0, 2}, {0, 1, 2, 4, 3, 0});
    EXPECT_EQ(value_at(track, 1), 1.5F);
    // u = 0.25: h00 = 0.84375, h10 = 0.140625, h01 = 0.15625, h11 = -0.046875:
    // 0.84375 + 2 * 0.140625 * 2 + 0.15625 * 3 + 2 * -0.046875 * 4 = 1.5.
    EXPECT_EQ(value_at(track, 0.5F), 1.5F);
    // u = 0.75: 0.15625 + 2 * 0.046875 * 2 + 0.84375 * 3 + 2 * -0.140625 * 4 = 1.75.
    EXPECT_EQ(value_at(track, 1.5F), 1.75F);
    EXPECT_EQ(value_at(track, 0), 1);
    EXPECT_EQ(value_at(track, 2), 3);
}

TEST(Curve, HoldsBeyondBothEndsInEveryMode) {
    const Track tracks[] = {scalar(Interpolation::step, {1, 2}, {5, 7}), scalar(Interpolation::linear, {1, 2}, {5, 7}),
                            scalar(Interpolation::cubic_spline, {1, 2}, {9, 5, 9, 9, 7, 9})};
    for (const Track& track : tracks) {
        EXPECT_EQ(value_at(track, 0), 5);
        EXPECT_EQ(value_at(track, -infinity), 5);
        EXPECT_EQ(value_at(track, 1), 5);
        EXPECT_EQ(value_at(track, 2), 7);
        EXPECT_EQ(value_at(track, 1e30F), 7);
        EXPECT_EQ(value_at(track, infinity), 7);
        EXPECT_EQ(value_at(track, nan_time), 5);
    }
}

TEST(Curve, OneKeyIsItsValueAtEveryTime) {
    const Track tracks[] = {scalar(Interpolation::step, {3}, {5}), scalar(Interpolation::linear, {3}, {5}),
                            scalar(Interpolation::cubic_spline, {3}, {100, 5, 100})};
    for (const Track& track : tracks) {
        for (const float time : {0.0F, 3.0F, 9.0F, nan_time}) EXPECT_EQ(value_at(track, time), 5);
    }
}

TEST(Curve, WritesEveryComponentAndNothingElse) {
    const Track track{.interpolation = Interpolation::cubic_spline,
                      .width = 2,
                      .times_seconds = {0, 1},
                      .values = {0, 0, 1, 10, 0, 0, 0, 0, 3, 30, 0, 0}};
    std::array<float, 3> out = {-1, -1, -1};
    sample(track, 0.5F, out);
    EXPECT_EQ(out, (std::array<float, 3>{2, 20, -1}));
}

TEST(Curve, HugeFiniteKeysStayFinite) {
    const float most = std::numeric_limits<float>::max();
    const Track line = scalar(Interpolation::linear, {-most, most}, {-most, most});
    const Track cubic = scalar(Interpolation::cubic_spline, {0, most}, {most, most, most, -most, most, most});
    for (const float time : {-1.0F, 0.0F, 1.0F, most / 2}) {
        EXPECT_TRUE(std::isfinite(value_at(line, time))) << time;
        EXPECT_TRUE(std::isfinite(value_at(cubic, time))) << time;
    }
    EXPECT_EQ(value_at(line, 0), 0);
}

glm::quat rotation_at(const Track& track, float time_seconds) { return glm_of(sample_rotation(track, time_seconds)); }

Track rotations(Interpolation interpolation, const glm::quat& a, const glm::quat& b) {
    return {.interpolation = interpolation,
            .width = 4,
            .times_seconds = {0, 1},
            .values = {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w}};
}

glm::quat about_y(double radians) {
    return glm::quat(static_cast<float>(std::cos(radians / 2)), 0, static_cast<float>(std::sin(radians / 2)), 0);
}

void expect_same_rotation(const glm::quat& a, const glm::quat& b, double tolerance) {
    EXPECT_NEAR(std::abs(static_cast<double>(glm::dot(a, b))), 1, tolerance);
}

TEST(Rotation, SlerpTurnsAtConstantSpeed) {
    const Track track = rotations(Interpolation::linear, about_y(0), about_y(2.0));
    for (int i = 0; i <= 8; ++i) {
        const glm::quat found = rotation_at(track, static_cast<float>(i) / 8);
        const glm::quat wanted = about_y(2.0 * i / 8);
        EXPECT_NEAR(found.y, wanted.y, 1e-6);
        EXPECT_NEAR(found.w, wanted.w, 1e-6);
    }
}

TEST(Rotation, TakesTheShorterArc) {
    const glm::quat end = about_y(1.0);
    const Track track = rotations(Interpolation::linear, about_y(0), -end);
    expect_same_rotation(rotation_at(track, 0.5F), about_y(0.5), 1e-6);
}

TEST(Rotation, NearlyEqualKeysDoNotLoseTheirDifference) {
    for (const double angle : {1e-3, 2.1e-4, 1.9e-4, 1e-6}) {
        const Track track = rotations(Interpolation::linear, about_y(0), about_y(angle));
        const glm::quat half = rotation_at(track, 0.5F);
        EXPECT_NEAR(half.y, angle / 4, angle * 1e-5) << angle;
        EXPECT_NEAR(glm::length(half), 1, 1e-6);
    }
}

TEST(Rotation, EqualAndNegatedKeysStayPut) {
    const glm::quat q = about_y(0.7);
    for (const glm::quat& end : {q, -q}) {
        const Track track = rotations(Interpolation::linear, q, end);
        for (const float time : {0.0F, 0.3F, 1.0F}) expect_same_rotation(rotation_at(track, time), q, 1e-6);
    }
}

TEST(Rotation, HalfTurnApartIsUnitAndOnAnArcBetween) {
    // The two keys are a half turn apart (dot product 0): both arcs are equally long, the result must still be one.
    const Track track = rotations(Interpolation::linear, glm::quat(1, 0, 0, 0), glm::quat(0, 0, 1, 0));
    const glm::quat half = rotation_at(track, 0.5F);
    EXPECT_NEAR(glm::length(half), 1, 1e-6);
    EXPECT_NEAR(std::abs(half.y), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(std::abs(half.w), std::sqrt(0.5), 1e-6);
}

TEST(Rotation, StepCubicAndNanTime) {
    const glm::quat a = about_y(0.2), b = about_y(1.2);
    const Track step = rotations(Interpolation::step, a, b);
    expect_same_rotation(rotation_at(step, 0.99F), a, 1e-6);
    expect_same_rotation(rotation_at(step, 1), b, 1e-6);
    expect_same_rotation(rotation_at(step, nan_time), a, 1e-6);

    Track cubic = step;
    cubic.interpolation = Interpolation::cubic_spline;
    cubic.values = {0, 0, 0, 0, a.x, a.y, a.z, a.w, 0, 0, 0, 0, 0, 0, 0, 0, b.x, b.y, b.z, b.w, 0, 0, 0, 0};
    // With level tangents the middle is the normalised mean of both keys: half way between the angles.
    expect_same_rotation(rotation_at(cubic, 0.5F), about_y(0.7), 1e-6);
    EXPECT_NEAR(glm::length(rotation_at(cubic, 0.25F)), 1, 1e-6);
}

TEST(Rotation, KeysOfNoLengthAndSplinesThroughZeroAreNoRotation) {
    const glm::quat none(0, 0, 0, 0), q = about_y(1);
    EXPECT_EQ(rotation_at(rotations(Interpolation::step, none, none), 0), glm::quat(1, 0, 0, 0));
    Track cubic{.interpolation = Interpolation::cubic_spline, .width = 4, .times_seconds = {0, 1}, .values = {}};
    cubic.values = {0, 0, 0, 0, q.x, q.y, q.z, q.w, 0, 0, 0, 0, 0, 0, 0, 0, -q.x, -q.y, -q.z, -q.w, 0, 0, 0, 0};
    EXPECT_EQ(rotation_at(cubic, 0.5F), glm::quat(1, 0, 0, 0));
}

/// Random tracks; the seed is fixed, so that a failure can be seen again.
Track random_track(std::mt19937& random, Interpolation interpolation) {
    std::uniform_real_distribution<float> step(0.01F, 0.5F), value(-1, 1);
    Track track{.interpolation = interpolation, .width = 1, .times_seconds = {}, .values = {}};
    float time = 0;
    for (int i = 0; i < 12; ++i) {
        track.times_seconds.push_back(time += step(random));
        const int per_key = interpolation == Interpolation::cubic_spline ? 3 : 1;
        for (int k = 0; k < per_key; ++k) track.values.push_back(value(random));
    }
    return track;
}

TEST(CurveLaw, LinearAndCubicHaveNoJump) {
    std::mt19937 random(1);
    for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic_spline}) {
        for (int round = 0; round < 50; ++round) {
            const Track track = random_track(random, interpolation);
            // Values and tangents are within 1, steps at least 0.01 s: no slope is steeper than 1.5 * 2 / 0.01 + 2.
            constexpr float steepest = 302, dt = 1e-4F;
            for (float time = 0; time < track.times_seconds.back() + 0.1F; time += dt) {
                // 1e-6: a float's rounding of values near 1, and of the time itself.
                ASSERT_NEAR(value_at(track, time), value_at(track, time + dt), steepest * dt * 1.01F + 1e-6F) << time;
            }
            for (const float key : track.times_seconds) {
                const float before = value_at(track, std::nextafter(key, 0.0F));
                const float after = value_at(track, std::nextafter(key, 100.0F));
                ASSERT_NEAR(before, value_at(track, key), 2e-4F) << key;
                ASSERT_NEAR(after, value_at(track, key), 2e-4F) << key;
            }
        }
    }
}

TEST(CurveLaw, TheSameInputGivesTheSameBits) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> any_time(-1, 7);
    for (const Interpolation interpolation :
         {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
        const Track track = random_track(random, interpolation), copy = track;
        std::vector<float> times(500);
        for (float& time : times) time = any_time(random);
        std::vector<std::uint32_t> forward;
        for (const float time : times) forward.push_back(std::bit_cast<std::uint32_t>(value_at(track, time)));
        for (std::size_t i = times.size(); i-- > 0;) {  // in the other order: no state may carry over
            ASSERT_EQ(forward[i], std::bit_cast<std::uint32_t>(value_at(copy, times[i])));
        }
    }
}

}  // namespace
}  // namespace blush
