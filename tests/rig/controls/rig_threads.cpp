// One rig, evaluated by four threads at once.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/four_threads.h"
#include "tests/rig/controls/named_face.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

std::vector<float> some_controls(const Rig& rig, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<float> controls(rig.control_names().size());
    std::ranges::generate(controls, [&] { return random.between(-0.5F, 1); });
    return controls;
}

std::vector<float> evaluated(const Rig& rig, std::uint64_t seed, Pose& pose) {
    rig.evaluate(some_controls(rig, seed), pose);
    std::vector<float> all = pose.weights;
    for (const std::vector<float>* more : {&pose.wrinkles, &pose.hemoglobin, &pose.acting})
        all.insert(all.end(), more->begin(), more->end());
    return all;
}

TEST(RigThreads, OneRigGivesFourThreadsWhatItGivesOne) {
    constexpr std::uint64_t rounds = 50;
    const Face face = test::arkit_face();
    const Rig rig(face, default_description(face));
    // The first rig of the program, so that what is made once is made here: nothing is evaluated before.
    const auto found = test::on_four_threads([&](std::size_t thread) {
        const Rig own(face, default_description(face));
        Pose pose = rig.rest_pose();
        std::vector<std::vector<float>> poses;
        for (std::uint64_t i = 0; i < rounds; ++i)
            poses.push_back(evaluated(i % 2 == 0 ? rig : own, thread * rounds + i, pose));
        return poses;
    });
    Pose pose = rig.rest_pose();
    for (std::size_t thread = 0; thread < test::thread_count; ++thread) {
        for (std::uint64_t i = 0; i < rounds; ++i)
            EXPECT_EQ(found[thread][i], evaluated(rig, thread * rounds + i, pose)) << thread << ", " << i;
    }
}

}  // namespace
}  // namespace blush
