// A face of 8,192 targets animates and evaluates: nothing in the way is sized for a usual face.

#include <gtest/gtest.h>

#include "rig/deform/deform.h"
#include "rig/motion/performance.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

constexpr std::uint32_t target_count = 8192;

/// Target t moves one vertex by (0, 0, 1); its weight goes from 0 at 0 s to t / 8192 at 1 s.
Face animated_face() {
    Face face = test::make_face({.side = 8, .targets = 1});
    const auto vertices = static_cast<std::uint32_t>(face.positions.size());
    face.targets.clear();
    WeightChannel channel;
    channel.track.width = target_count;
    channel.track.times_seconds = {0, 1};
    channel.track.values.assign(std::size_t{2} * target_count, 0);
    for (std::uint32_t t = 0; t < target_count; ++t) {
        Target target;
        target.name = "t" + std::to_string(t);
        target.vertices = {t % vertices};
        target.position_deltas = {glm::vec3(0, 0, 1)};
        face.targets.push_back(std::move(target));
        channel.targets.push_back(t);
        channel.track.values[target_count + t] = static_cast<float>(t) / target_count;
    }
    face.animations = {{"all", {}, {channel}, 1}};
    return face;
}

TEST(ManyTargets, AnimateAndEvaluate) {
    const Face face = animated_face();
    const Status valid = validate(face);
    ASSERT_TRUE(valid) << valid.error().message;
    const Rig rig(face);
    const BoundPerformance performance(performance_from_animations(face, std::nullopt), rig);
    EXPECT_TRUE(performance.unmatched_channels().empty());
    EXPECT_TRUE(performance.undriven_targets().empty());

    std::vector<float> controls(rig.control_names().size(), 0);
    Pose pose = rig.rest_pose();
    performance.sample(0.5F, controls, pose);
    rig.evaluate(controls, pose);
    EXPECT_EQ(pose.weights[0], 0);
    EXPECT_EQ(pose.weights[4096], 0.25F);
    EXPECT_EQ(pose.weights[8191], 0.5F * 8191 / target_count);

    Deformer deformer(face);
    DeformedSurface surface;
    deformer.deform(pose.weights, NormalMethod::authored, surface);
    // Weights t / 16384 are exact in a float, and so are their sums here.
    const auto vertices = static_cast<std::uint32_t>(face.positions.size());
    for (std::uint32_t v = 0; v < vertices; ++v) {
        double move = 0;
        for (std::uint32_t t = v; t < target_count; t += vertices) move += t / 16384.0;
        EXPECT_NEAR(surface.positions[v].z - face.positions[v].z, move, 1e-4) << v;
    }
}

}  // namespace
}  // namespace blush
