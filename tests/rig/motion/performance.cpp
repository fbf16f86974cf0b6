#include "rig/motion/performance.h"

#include <array>
#include <cmath>
#include <limits>
#include <new>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/motion/curve.h"
#include "tests/rig/count_allocations.h"

namespace blush {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Face face_with(const std::vector<std::string>& targets) {
    Face face;
    face.path = "face.glb";
    for (const std::string& name : targets) {
        Target target;
        target.name = name;
        target.default_weight = 0.5F;
        face.targets.push_back(target);
    }
    Node root, head;
    root.name = "root";
    head.name = "head";
    head.parent = 0;
    head.rest.translation = {1, 2, 3};
    face.nodes = {root, head};
    return face;
}

Track line(std::vector<float> times, std::vector<float> values) {
    return {.interpolation = Interpolation::linear,
            .width = 1,
            .times_seconds = std::move(times),
            .values = std::move(values)};
}

std::size_t index_of(const Rig& rig, std::string_view name) { return static_cast<std::size_t>(*rig.find(name)); }

TEST(Rig, ControlsAreTargetsThenAnglesThenExpressions) {
    const Rig rig(face_with({"jawOpen", "mouthSmile_L"}));
    EXPECT_EQ(rig.target_count(), 2U);
    EXPECT_THAT(std::vector<std::string>(rig.control_names().begin(), rig.control_names().begin() + 12),
                ElementsAre("jawOpen", "mouthSmile_L", "headYaw", "headPitch", "headRoll", "leftEyeYaw", "leftEyePitch",
                            "leftEyeRoll", "rightEyeYaw", "rightEyePitch", "rightEyeRoll", "AU1"));
    EXPECT_EQ(rig.find("jawOpen"), ControlId{0});
    EXPECT_EQ(rig.find("mouthSmileLeft"), ControlId{1});
    EXPECT_EQ(rig.find("HeadYaw"), ControlId{2});
    EXPECT_EQ(rig.find("tail"), std::nullopt);
}

TEST(Rig, RestPoseHasZeroWeightsAndNodesAtRest) {
    const Pose pose = Rig(face_with({"a", "b", "c"})).rest_pose();
    EXPECT_THAT(pose.weights, ElementsAre(0, 0, 0));
    ASSERT_EQ(pose.nodes.size(), 2U);
    EXPECT_EQ(pose.nodes[1].translation, glm::vec3(1, 2, 3));
    EXPECT_EQ(pose.head.yaw_radians, 0);
}

TEST(Rig, EvaluateCopiesWeightsAndAnglesAndLeavesNodes) {
    const Rig rig(face_with({"a", "b"}));
    Pose pose = rig.rest_pose();
    pose.nodes[1].translation = {9, 9, 9};
    std::vector<float> controls = {0.25F, -1.5F, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    controls.resize(rig.control_names().size(), 0.0F);
    rig.evaluate(controls, pose);
    EXPECT_THAT(pose.weights, ElementsAre(0.25F, -1.5F));
    EXPECT_EQ(pose.head.yaw_radians, 1);
    EXPECT_EQ(pose.head.pitch_radians, 2);
    EXPECT_EQ(pose.head.roll_radians, 3);
    EXPECT_EQ(pose.left_eye.yaw_radians, 4);
    EXPECT_EQ(pose.left_eye.roll_radians, 6);
    EXPECT_EQ(pose.right_eye.yaw_radians, 7);
    EXPECT_EQ(pose.right_eye.roll_radians, 9);
    EXPECT_EQ(pose.nodes[1].translation, glm::vec3(9, 9, 9));
}

TEST(Rig, WhatIsNotFiniteCountsAsZero) {
    const Rig rig(face_with({"a", "b", "c"}));
    Pose pose = rig.rest_pose();
    std::vector<float> controls(rig.control_names().size(), std::numeric_limits<float>::quiet_NaN());
    controls[1] = std::numeric_limits<float>::infinity();
    controls[2] = std::numeric_limits<float>::max();
    rig.evaluate(controls, pose);
    EXPECT_THAT(pose.weights, ElementsAre(0, 0, largest_weight));
    EXPECT_EQ(pose.head.yaw_radians, 0);
    EXPECT_EQ(pose.right_eye.pitch_radians, 0);
}

TEST(Rig, EvaluateAndSampleDoNotAllocate) {
    Face face = face_with({"a", "b"});
    Performance performance;
    performance.channels = {{"a", line({0, 1}, {0, 1})}};
    Track turn{.interpolation = Interpolation::linear, .width = 4, .times_seconds = {0, 1}, .values = {}};
    turn.values = {0, 0, 0, 1, 0, 1, 0, 0};
    performance.nodes = {{.node = 1, .path = NodePath::rotation, .track = turn}};
    const Rig rig(face);
    const BoundPerformance bound(performance, rig);
    Pose pose = rig.rest_pose();
    std::vector<float> controls(rig.control_names().size(), 0.0F);

    std::size_t before = test::allocation_count();
    ::operator delete(::operator new(16));  // a plain call: compilers may leave out a new-expression
    ASSERT_GT(test::allocation_count(), before) << "the counter does not count";
    before = test::allocation_count();
    bound.sample(0.5F, controls, pose);
    rig.evaluate(controls, pose);
    EXPECT_EQ(test::allocation_count(), before);
    EXPECT_EQ(pose.weights[0], 0.5F);
}

WeightChannel weights(std::vector<std::uint32_t> targets, Interpolation interpolation, std::vector<float> times,
                      std::vector<float> values) {
    const auto width = static_cast<std::uint32_t>(targets.size());
    return {.targets = std::move(targets),
            .track = {.interpolation = interpolation,
                      .width = width,
                      .times_seconds = std::move(times),
                      .values = std::move(values)}};
}

TEST(FromAnimations, SplitsWeightsExactlyInEveryMode) {
    for (const Interpolation interpolation :
         {Interpolation::step, Interpolation::linear, Interpolation::cubic_spline}) {
        Face face = face_with({"a", "b", "c"});
        const std::size_t per_key = interpolation == Interpolation::cubic_spline ? 9 : 3;
        std::vector<float> values;
        for (std::size_t i = 0; i < 3 * per_key; ++i) values.push_back(std::sin(static_cast<float>(i) * 1.7F));
        face.animations = {{.name = "talk",
                            .nodes = {},
                            .weights = {weights({2, 0, 1}, interpolation, {0.5F, 1, 2.25F}, values)},
                            .duration_seconds = 2.25F}};
        const Performance performance = performance_from_animations(face, 0);
        EXPECT_EQ(performance.name, "talk");
        EXPECT_EQ(performance.duration_seconds, 2.25F);
        EXPECT_THAT(performance.notes, IsEmpty());
        ASSERT_EQ(performance.channels.size(), 3U);
        EXPECT_EQ(performance.channels[0].name, "c");
        EXPECT_EQ(performance.channels[1].name, "a");
        for (float time = 0; time < 3; time += 0.0625F) {
            std::array<float, 3> together{};
            sample(face.animations[0].weights[0].track, time, together);
            for (std::size_t k = 0; k < 3; ++k) {
                float alone = -99;
                sample(performance.channels[k].track, time, {&alone, 1});
                ASSERT_EQ(alone, together[k]);
            }
        }
    }
}

Face face_with_two_animations() {
    Face face = face_with({"a", "b", "c"});
    NodeChannel move{.node = 1, .path = NodePath::translation, .track = {}};
    move.track = {
        .interpolation = Interpolation::step, .width = 3, .times_seconds = {0, 7}, .values = {0, 0, 0, 4, 5, 6}};
    face.animations = {{.name = "one",
                        .nodes = {},
                        .weights = {weights({0, 1}, Interpolation::linear, {0, 1}, {0, 0, 1, 1})},
                        .duration_seconds = 1},
                       {.name = "two",
                        .nodes = {move},
                        .weights = {weights({1, 2}, Interpolation::linear, {0, 2}, {0.5F, 0.5F, 0.25F, 0.25F})},
                        .duration_seconds = 7}};
    return face;
}

TEST(FromAnimations, AllTogetherLetTheLaterWinWithANote) {
    const Performance performance = performance_from_animations(face_with_two_animations(), std::nullopt);
    EXPECT_EQ(performance.name, "all animations");
    EXPECT_EQ(performance.duration_seconds, 7);
    ASSERT_EQ(performance.channels.size(), 3U);
    EXPECT_EQ(performance.channels[1].name, "b");
    EXPECT_EQ(performance.channels[1].track.values[0], 0.5F);
    EXPECT_THAT(performance.notes,
                ElementsAre("animation 'two' replaces 1 earlier track of the same thing (first: b)"));
}

TEST(FromAnimations, MeshesThatRepeatACurveAreNoConflict) {
    Face face = face_with_two_animations();
    face.animations.pop_back();
    face.animations[0].weights.push_back(face.animations[0].weights[0]);
    const Performance performance = performance_from_animations(face, std::nullopt);
    EXPECT_EQ(performance.channels.size(), 2U);
    EXPECT_THAT(performance.notes, IsEmpty());
    EXPECT_EQ(performance.name, "one");
}

TEST(FromAnimations, AnIndexBeyondTheEndIsANote) {
    const Performance performance = performance_from_animations(face_with_two_animations(), 2);
    EXPECT_THAT(performance.channels, IsEmpty());
    EXPECT_THAT(performance.notes, ElementsAre("face.glb has no animation 2, only 2"));
    EXPECT_EQ(performance_from_animations(face_with({}), std::nullopt).duration_seconds, 0);
}

TEST(Bound, NamesWhatHasNoMatchOnEitherSide) {
    const Rig rig(face_with({"jawOpen", "mouthSmile_L", "extra"}));
    Performance performance;
    performance.channels = {{"MouthSmileLeft", line({0}, {0.5F})},
                            {"tail", line({0}, {1})},
                            {"headYaw", line({0}, {0.125F})},
                            {"JAW_OPEN", line({0}, {0.25F})},
                            {"wings", line({0}, {1})}};
    const BoundPerformance bound(performance, rig);
    EXPECT_THAT(bound.unmatched_channels(), ElementsAre("tail", "wings"));
    EXPECT_THAT(bound.undriven_targets(), ElementsAre("extra"));

    std::vector<float> controls(rig.control_names().size(), -3.0F);
    Pose pose = rig.rest_pose();
    bound.sample(0, controls, pose);
    EXPECT_EQ(controls[0], 0.25F);
    EXPECT_EQ(controls[1], 0.5F);
    EXPECT_EQ(controls[2], -3) << "an undriven control must stay as it was";
    EXPECT_EQ(controls[index_of(rig, "headYaw")], 0.125F);
    EXPECT_EQ(controls[index_of(rig, "headPitch")], -3);
}

TEST(Bound, OfTwoChannelsForOneControlTheLastWins) {
    const Rig rig(face_with({"jawOpen"}));
    Performance performance;
    performance.channels = {{"jawOpen", line({0}, {0.25F})}, {"JawOpen", line({0}, {0.75F})}};
    const BoundPerformance bound(performance, rig);
    std::vector<float> controls(rig.control_names().size(), 0.0F);
    Pose pose = rig.rest_pose();
    bound.sample(0, controls, pose);
    EXPECT_EQ(controls[0], 0.75F);
    EXPECT_THAT(bound.performance().notes,
                ElementsAre("channels 'jawOpen' and 'JawOpen' both drive 'jawOpen'; the last one plays"));
    EXPECT_THAT(bound.unmatched_channels(), IsEmpty());
}

TEST(Bound, MovesNodesAndDropsThoseThatTheFaceDoesNotHave) {
    const Face face = face_with_two_animations();
    const Rig rig(face);
    Performance performance = performance_from_animations(face, 1);
    performance.nodes.push_back({.node = 77, .path = NodePath::scale, .track = performance.nodes[0].track});
    const BoundPerformance bound(performance, rig);
    Pose pose = rig.rest_pose();
    std::vector<float> controls(rig.control_names().size(), 0.0F);
    bound.sample(7, controls, pose);
    EXPECT_EQ(pose.nodes[1].translation, glm::vec3(4, 5, 6));
    EXPECT_EQ(pose.nodes[0].translation, glm::vec3(0));
    EXPECT_THAT(bound.performance().notes, ElementsAre("1 node tracks move nodes that this face does not have"));
}

}  // namespace
}  // namespace blush
