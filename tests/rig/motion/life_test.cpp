/// Life within published bounds, and its laws.

#include "rig/motion/life.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "rig/names.h"
#include "tests/rig/count_allocations.h"

namespace blush {
namespace {

constexpr double degrees_a_radian = 57.29577951308232;

Face face_with_arkit() {
    Face face;
    face.path = "face.glb";
    for (const std::string_view name : arkit_names) {
        face.targets.emplace_back();
        face.targets.back().name = name;
    }
    return face;
}

class LifeTest : public testing::Test {
protected:
    std::vector<float> controls_of(const Life& life) const {
        std::vector<float> controls(rig.control_names().size(), 0);
        life.add_to(controls);
        return controls;
    }
    float value(const Life& life, const char* name) const {
        return controls_of(life)[static_cast<std::size_t>(*rig.find(name))];
    }
    const Rig rig{face_with_arkit()};
};

TEST_F(LifeTest, TheSameSeedGivesTheSameBits) {
    Life first(rig, {.seed = 7}), second(rig, {.seed = 7}), other(rig, {.seed = 8});
    bool differs = false;
    for (int i = 0; i < 1200; ++i) {
        first.step(1.0 / 60);
        second.step(1.0 / 60);
        other.step(1.0 / 60);
        ASSERT_EQ(controls_of(first), controls_of(second)) << i;
        differs = differs || controls_of(first) != controls_of(other);
    }
    EXPECT_TRUE(differs);
}

TEST_F(LifeTest, ComesBackToACopiedState) {
    Life life(rig, {});
    life.step(3.3);
    const LifeState state = life.state();
    life.step(4);
    const std::vector<float> after = controls_of(life);
    life.restore(state);
    life.step(4);
    EXPECT_EQ(controls_of(life), after);
}

TEST_F(LifeTest, DoesNotDependOnTheFrameRate) {
    Life coarse(rig, {.talking = true}), fine(rig, {.talking = true});
    for (int second = 0; second < 60; ++second) {
        for (int i = 0; i < 8; ++i) coarse.step(1.0 / 8);
        for (int i = 0; i < 240; ++i) fine.step(1.0 / 240);
        const std::vector<float> a = controls_of(coarse), b = controls_of(fine);
        for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-5F) << rig.control_names()[i];
    }
    EXPECT_EQ(coarse.state().blinks_begun, fine.state().blinks_begun);
    EXPECT_EQ(coarse.state().saccades_begun, fine.state().saccades_begun);
}

TEST_F(LifeTest, PartsThatAreOffAddNothingAndChangeNoOther) {
    Life none(rig, {.blinks = false, .gaze = false, .breath = false, .head = false});
    Life all(rig, {}), blinks(rig, {.gaze = false, .breath = false, .head = false}),
        head(rig, {.blinks = false, .gaze = false});
    for (int i = 0; i < 600; ++i) {
        for (Life* life : {&none, &all, &blinks, &head}) life->step(1.0 / 60);
        for (const float control : controls_of(none)) ASSERT_EQ(control, 0);
        ASSERT_EQ(value(blinks, "headYaw"), 0);
        ASSERT_EQ(value(head, "eyeBlinkLeft"), 0);
        ASSERT_EQ(value(head, "headRoll"), value(all, "headRoll"));
    }
}

TEST_F(LifeTest, BlinkRatesArePublishedOnes) {
    // Bentivoglio 1997: 17 a minute at rest, 26 in conversation. Doughty 2001: 8.0 to 21.0 in primary gaze and 10.5 to
    // 32.5 in conversation hold 95 % of adults. Evoked blinks come on top of the 17.
    for (const bool talking : {false, true}) {
        Life life(rig, {.talking = talking});
        life.step(60 * 60);
        const double a_minute = life.state().blinks_begun / 60.0;
        EXPECT_NEAR(a_minute, talking ? 27.0 : 17.5, 2.5);
    }
    Life still(rig, {.gaze = false, .blinks_a_minute = 4.5});
    still.step(60 * 60);
    EXPECT_NEAR(still.state().blinks_begun / 60.0, 4.5, 0.7);
}

TEST_F(LifeTest, BlinksTakeAsLongAsPublished) {
    // VanderWerf 2003: 334 ms with a deviation of 67.
    Life life(rig, {.gaze = false, .breath = false, .head = false});
    std::vector<double> durations;
    double began = -1, deepest = 0;
    for (int i = 0; i < 300'000; ++i) {
        life.step(1e-3);
        const double lids = life.state().blink.at(life.state().seconds);
        ASSERT_GE(lids, 0);
        ASSERT_LE(lids, 1);
        deepest = std::max(deepest, lids);
        if (lids > 0 && began < 0) began = life.state().seconds;
        if (lids == 0 && began >= 0) durations.push_back(life.state().seconds - std::exchange(began, -1));
    }
    ASSERT_GT(durations.size(), 50U);
    double sum = 0;
    for (const double duration : durations) {
        sum += duration;
        EXPECT_GT(duration, 0.334 - 2 * 0.067);
        EXPECT_LT(duration, 0.334 + 2 * 0.067);
    }
    EXPECT_NEAR(sum / static_cast<double>(durations.size()), 0.334, 0.02);
    EXPECT_NEAR(deepest, 1, 1e-3);
}

TEST_F(LifeTest, LidsNeverPassShut) {
    Life life(rig, {});
    for (const float below : {0.0F, 0.4F, 1.0F, 1.5F}) {
        for (int i = 0; i < 3000; ++i) {
            life.step(0.01);
            std::vector<float> controls(rig.control_names().size(), 0);
            const auto lid = static_cast<std::size_t>(*rig.find("eyeBlinkLeft"));
            controls[lid] = below;
            life.add_to(controls);
            ASSERT_LE(controls[lid], std::max(1.0F, below) + 1e-6F);
            ASSERT_GE(controls[lid], below);
        }
    }
}

TEST_F(LifeTest, SaccadesFollowTheMainSequence) {
    // Bahill, Clark, Stark 1975: peak velocity grows with size and saturates; about 250, 400 and 500 degrees a second
    // for 5, 10 and 20 degrees.
    for (const auto& [degrees, peak] : {std::pair{5.0, 250.0}, std::pair{10.0, 400.0}, std::pair{20.0, 520.0}}) {
        Life life(rig, {.blinks = false, .gaze = false, .breath = false, .head = false});
        life.step(0.1);
        const LifeWish wish{.look = true, .yaw_radians = degrees / degrees_a_radian, .distance_metres = 100};
        double fastest = 0, last = 0;
        for (int i = 0; i < 300; ++i) {
            life.step(1e-3, wish);
            const double yaw = life.state().eyes.at(life.state().seconds).yaw_radians * degrees_a_radian;
            fastest = std::max(fastest, (yaw - last) / 1e-3);
            last = yaw;
        }
        EXPECT_NEAR(last, degrees, 1e-9);
        EXPECT_NEAR(fastest, peak, 0.25 * peak) << degrees;
    }
}

TEST_F(LifeTest, BothEyesMeetInTheirPoint) {
    for (const double distance : {0.3, 1.0, 4.0}) {
        Life life(rig, {.blinks = false, .gaze = false, .breath = false, .head = false});
        const LifeWish wish{.look = true, .yaw_radians = 0.1, .pitch_radians = 0, .distance_metres = distance};
        for (int i = 0; i < 100; ++i) life.step(0.01, wish);
        const double left = static_cast<double>(value(life, "leftEyeYaw") + value(life, "headYaw"));
        const double right = static_cast<double>(value(life, "rightEyeYaw") + value(life, "headYaw"));
        // Two lines from the pupils, 63 mm apart: where they cross.
        const double ahead = 0.063 / (std::tan(right) - std::tan(left));
        const double side = 0.0315 + ahead * std::tan(left);
        EXPECT_NEAR(std::hypot(ahead, side), distance, 0.01 * distance);
        EXPECT_NEAR(std::atan2(side, ahead), 0.1, 1e-3);
        EXPECT_LT(left, right) << "eyes turn inwards";
    }
}

TEST_F(LifeTest, TheEyesStayOnTheirPointWhileTheHeadMoves) {
    Life life(rig, {.blinks = false, .gaze = false, .breath = true, .head = true});
    const LifeWish wish{.look = true, .yaw_radians = 0.5, .pitch_radians = 0.1, .distance_metres = 1};
    life.step(0.2, wish);
    for (int i = 0; i < 500; ++i) {
        life.step(0.01, wish);
        const double gaze = static_cast<double>(value(life, "leftEyeYaw") + value(life, "rightEyeYaw")) / 2 +
                            static_cast<double>(value(life, "headYaw"));
        ASSERT_NEAR(gaze, 0.5, 2e-3);
        ASSERT_LE(std::abs(value(life, "leftEyeYaw")), 0.62F);
    }
    EXPECT_GT(value(life, "headYaw"), 0.15F) << "the head takes its part of a large shift";
}

TEST_F(LifeTest, LooksAtItsPartnerAsLongAsPublished) {
    // Lee, Badler, Badler 2002, listening: 237.5 frames at, 13 frames away; talking: 93.9 and 27.8.
    for (const bool talking : {false, true}) {
        Life life(rig, {.blinks = false, .talking = talking});
        double away = 0;
        constexpr double step = 0.02, whole = 3600;
        for (double time = 0; time < whole; time += step) {
            life.step(step);
            away += life.state().away ? step : 0;
        }
        const double published = talking ? 27.8 / (27.8 + 93.9) : 13.0 / (13 + 237.5);
        EXPECT_NEAR(away / whole, published, 0.15 * published);
    }
}

TEST_F(LifeTest, BreathesTwelveToSixteenTimesAMinute) {
    Life life(rig, {});
    life.step(3600);
    EXPECT_GT(life.state().breaths_begun / 60.0, 12);
    EXPECT_LT(life.state().breaths_begun / 60.0, 16);
    for (int i = 0; i < 1000; ++i) {
        life.step(0.01);
        ASSERT_GE(life.breath(), 0);
        ASSERT_LE(life.breath(), 1.2);
    }
}

TEST_F(LifeTest, NothingJumps) {
    Life life(rig, {.talking = true});
    std::vector<float> last = controls_of(life);
    for (const float control : last)
        EXPECT_NEAR(control, 0, 0.06F) << "begins at rest, but for the eyes on their partner";
    for (int i = 0; i < 60'000; ++i) {
        life.step(1e-3);
        const std::vector<float> now = controls_of(life);
        // The fastest that there is: a lid that closes in 78 ms, at 1.875 times its mean speed.
        for (std::size_t c = 0; c < now.size(); ++c) {
            ASSERT_LT(std::abs(now[c] - last[c]), 1.875e-3F / 0.078F + 1e-4F) << rig.control_names()[c] << i;
        }
        last = now;
    }
}

TEST_F(LifeTest, OddStepsAndWishesAreHarmless) {
    Life life(rig, {.seed = 0, .blinks_a_minute = 1e9, .breaths_a_minute = -3});
    for (const double odd : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 0.0, 1e-300, 1e4}) {
        life.step(odd, {.look = true, .yaw_radians = 1.5, .pitch_radians = -1.5, .distance_metres = 0});
        for (const float control : controls_of(life)) ASSERT_TRUE(std::isfinite(control)) << odd;
        life.step(odd);
    }
}

TEST_F(LifeTest, DoesNotAllocate) {
    Life life(rig, {});
    std::vector<float> controls(rig.control_names().size(), 0);
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 1000; ++i) {
        life.step(0.02);
        life.add_to(controls);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace blush
