// The rig on a real head, and under a real recording.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "rig/motion/performance.h"
#include "runtime/files/face_file.h"
#include "runtime/files/performance/performance_file.h"
#include "tests/rig/controls/named_face.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

using testing::IsEmpty;

TEST(RigOnRealHeads, FaceCapPerformsEveryExpressionOnItsOwnShapes) {
    BLUSH_SHARED_OR_SKIP(file, "faces/facecap/facecap_plain.glb");
    const Result<Face> face = load_face(file);
    ASSERT_TRUE(face) << face.error().message;
    test::PosedRig posed(*face);
    EXPECT_THAT(posed.rig.unmatched_arkit(), IsEmpty());
    EXPECT_THAT(posed.rig.unmatched_drives(), IsEmpty());
    std::vector<std::vector<float>> seen;
    for (const std::string_view emotion : {"joy", "sadness", "anger", "fear", "disgust", "surprise"}) {
        posed.with({{emotion, 1}});
        EXPECT_GE(std::ranges::count_if(posed.pose.weights, [](float weight) { return weight > 0.1F; }), 6) << emotion;
        for (const std::vector<float>& other : seen) {
            float difference = 0;
            for (std::size_t t = 0; t < other.size(); ++t) difference += std::abs(other[t] - posed.pose.weights[t]);
            EXPECT_GT(difference, 2) << emotion << " looks like another one";
        }
        seen.push_back(posed.pose.weights);
    }
}

TEST(RigOnRealHeads, ALiveLinkRecordingWrinklesAndColours) {
    BLUSH_SHARED_OR_SKIP(file, "performances/livelink/alex_rom_3.csv");
    const Result<Performance> performance = load_performance(file);
    ASSERT_TRUE(performance) << performance.error().message;
    for (const Face& face : {test::arkit_face(), test::split_face()}) {
        test::PosedRig posed(face);
        const BoundPerformance bound(*performance, posed.rig);
        std::vector<float> most(posed.rig.wrinkle_zones().size(), 0.0F);
        float most_joy = 0;
        for (float time = 0; time < bound.duration_seconds(); time += 0.25F) {
            bound.sample(time, posed.controls, posed.pose);
            posed.rig.evaluate(posed.controls, posed.pose);
            for (std::size_t zone = 0; zone < most.size(); ++zone) {
                EXPECT_GE(posed.pose.wrinkles[zone], 0);
                EXPECT_LE(posed.pose.wrinkles[zone], 1);
                most[zone] = std::max(most[zone], posed.pose.wrinkles[zone]);
            }
            most_joy = std::max(most_joy, posed.blood("joy"));
            EXPECT_EQ(posed.pose.hemoglobin_factor, 1);
        }
        // A range-of-motion recording visits every region of the face.
        EXPECT_THAT(most, testing::Each(testing::Gt(0.15F)));
        EXPECT_GT(most_joy, 0.15F);
    }
}

}  // namespace
}  // namespace blush
