#include "tools/blush/viewer_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace blush::tool {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

PlaybackClock two_to_five_seconds() {
    return {.from_seconds = 2, .to_seconds = 5, .frames_a_second = 10, .time_seconds = 2};
}

TEST(PlaybackClock, AdvancesByElapsedTimeAndSpeed) {
    PlaybackClock clock = two_to_five_seconds();
    clock.advance(0.5);
    EXPECT_DOUBLE_EQ(clock.time_seconds, 2.5);
    clock.faster();
    clock.advance(0.5);
    EXPECT_DOUBLE_EQ(clock.time_seconds, 3.5);
    clock.slower();
    clock.slower();
    clock.advance(0.5);
    EXPECT_DOUBLE_EQ(clock.time_seconds, 3.75);
}

TEST(PlaybackClock, BeginsAgainAfterTheEnd) {
    PlaybackClock clock = two_to_five_seconds();
    clock.advance(3.25);
    EXPECT_DOUBLE_EQ(clock.time_seconds, 2.25);
    clock.advance(300);  // a hundred loops at once
    EXPECT_NEAR(clock.time_seconds, 2.25, 1e-9);
    clock.scrub(5);
    clock.advance(0.5);
    EXPECT_DOUBLE_EQ(clock.time_seconds, 2.5) << "the end is where the beginning is";
}

TEST(PlaybackClock, StandsStillWhilePaused) {
    PlaybackClock clock = two_to_five_seconds();
    clock.playing = false;
    clock.advance(1);
    EXPECT_EQ(clock.time_seconds, 2);
}

TEST(PlaybackClock, IgnoresTimesThatMakeNoSense) {
    PlaybackClock clock = two_to_five_seconds();
    for (const double elapsed : {-1.0, nan, infinity, -infinity}) clock.advance(elapsed);
    for (const double wanted : {nan, infinity}) clock.scrub(wanted);
    EXPECT_EQ(clock.time_seconds, 2);
}

TEST(PlaybackClock, AStillStaysWhereItIs) {
    PlaybackClock clock{.from_seconds = 1, .to_seconds = 1, .time_seconds = 1};
    clock.advance(0.7);
    clock.step(1);
    clock.step(-1);
    clock.scrub(3);
    EXPECT_EQ(clock.time_seconds, 1);
}

TEST(PlaybackClock, StepsFromFrameToFrame) {
    PlaybackClock clock = two_to_five_seconds();
    // Thirty steps of a tenth, whose sum is not quite three: no frame may be shown twice or left out.
    for (int frame = 1; frame <= 30; ++frame) {
        clock.step(1);
        EXPECT_NEAR(clock.time_seconds, 2 + frame * 0.1, 1e-9);
    }
    for (int frame = 29; frame >= 0; --frame) {
        clock.step(-1);
        EXPECT_NEAR(clock.time_seconds, 2 + frame * 0.1, 1e-9);
    }
    EXPECT_FALSE(clock.playing) << "who steps wants to look";
}

TEST(PlaybackClock, StepsFromBetweenFramesToTheNearestOnThatSide) {
    PlaybackClock clock = two_to_five_seconds();
    clock.scrub(2.34);
    clock.step(1);
    EXPECT_NEAR(clock.time_seconds, 2.4, 1e-12);
    clock.scrub(2.34);
    clock.step(-1);
    EXPECT_NEAR(clock.time_seconds, 2.3, 1e-12);
}

TEST(PlaybackClock, StopsAtBothEnds) {
    PlaybackClock clock = two_to_five_seconds();
    clock.step(-1);
    EXPECT_EQ(clock.time_seconds, 2);
    clock.scrub(77);
    EXPECT_EQ(clock.time_seconds, 5);
    clock.step(1);
    EXPECT_EQ(clock.time_seconds, 5);
    clock.scrub(-77);
    EXPECT_EQ(clock.time_seconds, 2);
}

TEST(PlaybackClock, SpeedHasEnds) {
    PlaybackClock clock;
    for (int i = 0; i < 20; ++i) clock.faster();
    EXPECT_EQ(clock.speed, 8);
    for (int i = 0; i < 20; ++i) clock.slower();
    EXPECT_EQ(clock.speed, 0.125);
}

TEST(MakeClock, ANegativeEndIsThatOfThePerformance) {
    const Result<PlaybackClock> clock = make_clock(1, -1, 4, 25);
    ASSERT_TRUE(clock);
    EXPECT_EQ((*clock).from_seconds, 1);
    EXPECT_EQ((*clock).time_seconds, 1);
    EXPECT_EQ((*clock).to_seconds, 4);
    EXPECT_EQ((*clock).frames_a_second, 25);
    EXPECT_TRUE((*clock).playing);
}

TEST(MakeClock, RefusesWhatIsNoPartOfThePerformance) {
    const Result<PlaybackClock> backwards = make_clock(3, 2, 4, 30);
    ASSERT_FALSE(backwards);
    EXPECT_EQ(backwards.error().message,
              "--from 3.000000 --to 2.000000: not a part of a performance of 4.000000 seconds");
    EXPECT_FALSE(make_clock(5, -1, 4, 30)) << "begins after the end";
    EXPECT_FALSE(make_clock(0, -1, 4, 0)) << "no frames a second";
    EXPECT_FALSE(make_clock(0, -1, 4, nan));
    EXPECT_FALSE(make_clock(std::nanf(""), -1, 4, 30));
    EXPECT_FALSE(make_clock(0, std::nanf(""), 4, 30));
    EXPECT_FALSE(make_clock(0, std::numeric_limits<float>::infinity(), 4, 30));
}

}  // namespace
}  // namespace blush::tool
