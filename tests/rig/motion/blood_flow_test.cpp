/// The laws of a first-order model of blood.

#include "rig/motion/blood_flow.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rig/count_allocations.h"

namespace blush {
namespace {

const std::vector<std::string> maps = {"joy", "blush", "pallor"};

Pose wanting(float joy, float blush, float pallor, float factor = 1) {
    Pose pose;
    pose.hemoglobin = {joy, blush, pallor};
    pose.hemoglobin_factor = factor;
    return pose;
}

TEST(BloodFlow, RestStaysRestBitForBit) {
    BloodFlow blood(maps);
    for (const double step : {0.0, 1e-9, 0.1, 1e9}) blood.step(step, wanting(0, 0, 0));
    Pose pose = wanting(9, 9, 9, 9);
    blood.apply(pose);
    EXPECT_EQ(pose.hemoglobin, wanting(0, 0, 0).hemoglobin);
    EXPECT_EQ(pose.hemoglobin_factor, 1);
}

TEST(BloodFlow, ExpressionsComeAtOnceAndStatesTakeTheirTime) {
    BloodFlow blood(maps);
    blood.step(7, wanting(0.5F, 0.4F, 0));
    EXPECT_EQ(blood.state().shares[0], 0.5) << "finding 6";
    EXPECT_NEAR(blood.state().shares[1], static_cast<double>(0.4F) * (1 - std::exp(-1)), 1e-12)
        << "63 % after its time";
    blood.settle(wanting(0, 0.4F, 0));
    blood.step(30, wanting(0, 0, 0));
    EXPECT_NEAR(blood.state().shares[1], static_cast<double>(0.4F) * std::exp(-1), 1e-12)
        << "fades with its other time";
}

TEST(BloodFlow, GoesStraightToItsGoalAndNotBeyond) {
    BloodFlow blood(maps);
    double last = 0;
    for (int i = 0; i < 2000; ++i) {
        blood.step(0.05, wanting(0, 1, 0, 1.27F));
        ASSERT_GE(blood.state().shares[1], last);
        ASSERT_LE(blood.state().shares[1], 1);
        last = blood.state().shares[1];
    }
    EXPECT_NEAR(last, 1, 1e-5);
    for (int i = 0; i < 2000; ++i) {
        blood.step(0.05, wanting(0, 0.25F, 0, 0.81F));
        ASSERT_LE(blood.state().shares[1], last);
        ASSERT_GE(blood.state().shares[1], 0.25);
        last = blood.state().shares[1];
    }
}

TEST(BloodFlow, StepsMayBeCutAnyhow) {
    BloodFlow whole(maps), cut(maps);
    const Pose goal = wanting(0.2F, 0.7F, 0.1F, 1.27F);
    whole.step(5, goal);
    for (int i = 0; i < 500; ++i) cut.step(0.01, goal);
    for (std::size_t i = 0; i < maps.size(); ++i) EXPECT_NEAR(whole.state().shares[i], cut.state().shares[i], 1e-13);
    EXPECT_NEAR(whole.state().factor, cut.state().factor, 1e-13);
}

TEST(BloodFlow, SharesNeverAddUpToMoreThanAWhole) {
    BloodFlow blood(maps);
    blood.settle(wanting(0, 1, 0));
    Pose pose = wanting(1, 0, 0);
    blood.step(1, pose);
    blood.apply(pose);
    EXPECT_NEAR(pose.hemoglobin[0] + pose.hemoglobin[1] + pose.hemoglobin[2], 1, 1e-6);
    EXPECT_GT(pose.hemoglobin[1], 0.4F) << "the blush is still there under the smile";
}

TEST(BloodFlow, AFrameFollowsFromItsState) {
    BloodFlow blood(maps);
    blood.step(2, wanting(0, 1, 0));
    const BloodState state = blood.state();
    blood.step(1, wanting(0, 0, 1));
    const BloodState after = blood.state();
    blood.restore(state);
    blood.step(1, wanting(0, 0, 1));
    EXPECT_EQ(blood.state().shares, after.shares);
    BloodFlow fast(maps, 10);
    fast.step(0.2, wanting(0, 1, 0));
    EXPECT_NEAR(fast.state().shares[1], state.shares[1], 1e-12);
}

TEST(BloodFlow, OddStepsChangeNothing) {
    BloodFlow blood(maps);
    blood.settle(wanting(0, 0.5F, 0));
    for (const double odd : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        blood.step(odd, wanting(0, 1, 0));
        EXPECT_EQ(blood.state().shares[1], 0.5);
    }
}

TEST(BloodFlow, DoesNotAllocate) {
    BloodFlow blood(maps);
    Pose pose = wanting(0.1F, 1, 0);
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 100; ++i) {
        blood.step(0.1, pose);
        blood.apply(pose);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace blush
