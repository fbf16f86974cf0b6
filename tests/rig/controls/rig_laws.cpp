// Laws of the rig, on faces of which only the target names matter.

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/controls/expression_library.h"
#include "tests/rig/controls/named_face.h"
#include "tests/rig/count_allocations.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

using test::PosedRig;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::IsEmpty;

constexpr std::array<std::string_view, 6> basic_emotions = {"joy", "sadness", "anger", "fear", "disgust", "surprise"};

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

void expect_same(const Pose& a, const Pose& b) {
    const auto same = [](const std::vector<float>& x, const std::vector<float>& y) {
        return std::ranges::equal(x, y, same_bits);
    };
    EXPECT_TRUE(same(a.weights, b.weights));
    EXPECT_TRUE(same(a.wrinkles, b.wrinkles));
    EXPECT_TRUE(same(a.hemoglobin, b.hemoglobin));
    EXPECT_TRUE(same_bits(a.hemoglobin_factor, b.hemoglobin_factor));
    EXPECT_TRUE(same({a.head.yaw_radians, a.head.pitch_radians, a.head.roll_radians},
                     {b.head.yaw_radians, b.head.pitch_radians, b.head.roll_radians}));
}

std::vector<Face> faces() {
    return {test::arkit_face(), test::split_face(), test::named_face({"jawOpen", "mouthSmile", "mouthSmile_50"}),
            test::named_face({})};
}

TEST(RigLaws, ZeroControlsGiveTheRestPoseBitForBit) {
    for (const Face& face : faces()) {
        PosedRig posed(face);
        posed.with({});
        expect_same(posed.pose, posed.rig.rest_pose());
        for (float& control : posed.controls) control = -0.0F;
        posed.rig.evaluate(posed.controls, posed.pose);
        expect_same(posed.pose, posed.rig.rest_pose());
    }
}

TEST(RigLaws, AnOwnTargetAtOneIsExactlyThatTarget) {
    for (const Face& face : faces()) {
        PosedRig posed(face);
        for (std::size_t t = 0; t < face.targets.size(); ++t) {
            posed.with({{face.targets[t].name, 1.0F}});
            for (std::size_t other = 0; other < face.targets.size(); ++other) {
                EXPECT_EQ(posed.pose.weights[other], other == t ? 1.0F : 0.0F) << face.targets[t].name;
            }
        }
    }
}

TEST(RigLaws, EvaluationKeepsNothingFromBefore) {
    const Face face = test::split_face();
    PosedRig used(face), fresh(face);
    test::Random random(3);
    for (int round = 0; round < 50; ++round) {
        for (float& control : used.controls) control = random.between(-2, 2);
        used.rig.evaluate(used.controls, used.pose);
    }
    for (float& value : used.pose.scratch) value = std::numeric_limits<float>::quiet_NaN();
    used.with({{"fear", 0.5F}, {"AU12", 0.25F}, {"jawOpen", 0.125F}});
    fresh.with({{"fear", 0.5F}, {"AU12", 0.25F}, {"jawOpen", 0.125F}});
    expect_same(used.pose, fresh.pose);
}

TEST(RigLaws, SymmetricEmotionsGiveSymmetricFaces) {
    for (const Face& face : {test::arkit_face(), test::split_face()}) {
        PosedRig posed(face);
        for (const std::string_view one : basic_emotions) {
            for (const std::string_view other : basic_emotions) {
                posed.with({{one, 0.7F}, {other, 0.3F}});
                for (const std::string_view name : arkit_names) {
                    if (!name.ends_with("Left") || name == "jawLeft" || name == "mouthLeft") continue;
                    const std::string right = std::string(name.substr(0, name.size() - 4)) + "Right";
                    EXPECT_TRUE(same_bits(posed.weight(name), posed.weight(right))) << one << " " << name;
                }
                for (const std::string_view zone : {"foreheadOuter", "foreheadInner", "nose"}) {
                    EXPECT_TRUE(
                        same_bits(posed.zone(std::string(zone) + "Left"), posed.zone(std::string(zone) + "Right")));
                }
                EXPECT_EQ(posed.pose.head.yaw_radians, 0);
            }
        }
    }
}

TEST(RigLaws, EveryEmotionAndCompoundMovesAWholeFaceWithinRange) {
    const Face face = test::arkit_face();
    PosedRig posed(face);
    for (const Expression& expression : expression_library().expressions) {
        if (expression.drives.empty() || expression.kind == ControlKind::state) continue;
        posed.with({{expression.name, 1.0F}});
        const float moved = std::accumulate(posed.pose.weights.begin(), posed.pose.weights.end(), 0.0F) +
                            std::abs(posed.pose.head.yaw_radians) + std::abs(posed.pose.head.pitch_radians) +
                            std::abs(posed.pose.head.roll_radians);
        EXPECT_GT(moved, 0.25F) << expression.name;
        for (const float weight : posed.pose.weights) {
            EXPECT_GE(weight, 0) << expression.name;
            EXPECT_LE(weight, 1) << expression.name;
        }
    }
}

/// Largest step of any output between neighbouring poses of a path through `keys`, in `steps` steps a leg.
float largest_step(PosedRig& posed, const std::vector<std::vector<float>>& keys, int steps) {
    float largest = 0;
    Pose before = posed.pose;
    bool first = true;
    const auto compare = [&](const std::vector<float>& a, const std::vector<float>& b) {
        for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    };
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
        for (int i = 0; i <= steps; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(steps);
            for (std::size_t c = 0; c < posed.controls.size(); ++c) {
                posed.controls[c] = std::lerp(keys[k][c], keys[k + 1][c], t);
            }
            posed.rig.evaluate(posed.controls, posed.pose);
            if (!first) {
                compare(before.weights, posed.pose.weights);
                compare(before.wrinkles, posed.pose.wrinkles);
                compare(before.hemoglobin, posed.pose.hemoglobin);
                compare({before.hemoglobin_factor, before.head.pitch_radians, before.left_eye.yaw_radians},
                        {posed.pose.hemoglobin_factor, posed.pose.head.pitch_radians, posed.pose.left_eye.yaw_radians});
            }
            before = posed.pose;
            first = false;
        }
    }
    return largest;
}

TEST(RigLaws, NoPathOfWeightsHasAJump) {
    std::vector<std::string> names(arkit_names.begin(), arkit_names.end());
    names.insert(names.end(), {"jawOpen_mouthSmileLeft", "jawOpen_25", "jawOpen_50", "browDownLeft_browInnerUp"});
    PosedRig posed(test::named_face(names));
    ASSERT_EQ(posed.rig.program().correctives.size(), 2U);
    ASSERT_EQ(posed.rig.program().in_between_targets.size(), 2U);
    test::Random random(11);
    for (int path = 0; path < 20; ++path) {
        // Through and beyond the ends of the range, where clamps begin.
        std::vector<std::vector<float>> keys(3, std::vector<float>(posed.controls.size(), 0.0F));
        for (auto& key : keys) {
            for (float& value : key) value = random.between(0, 1) < 0.7F ? 0.0F : random.between(-0.3F, 1.3F);
        }
        const float coarse = largest_step(posed, keys, 200), fine = largest_step(posed, keys, 1600);
        // A continuous path takes an eighth of the step; a jump stays as large.
        EXPECT_LT(fine, 0.2F * coarse) << path;
        EXPECT_LT(fine, 0.02F) << path;
    }
}

TEST(RigLaws, WrinklesAndBloodStayInRange) {
    const Face face = test::split_face();
    PosedRig posed(face);
    test::Random random(5);
    for (int round = 0; round < 500; ++round) {
        for (float& control : posed.controls) control = random.between(0, 1) < 0.8F ? 0.0F : random.between(-3, 3);
        posed.rig.evaluate(posed.controls, posed.pose);
        float sum = 0;
        for (const float share : posed.pose.hemoglobin) {
            EXPECT_GE(share, 0);
            sum += share;
        }
        EXPECT_LE(sum, 1 + 1e-5F);
        EXPECT_GE(posed.pose.hemoglobin_factor, 0.81F - 1e-5F);
        EXPECT_LE(posed.pose.hemoglobin_factor, 1.27F + 1e-5F);
        for (const float zone : posed.pose.wrinkles) {
            EXPECT_GE(zone, 0);
            EXPECT_LE(zone, 1);
        }
    }
}

// The first eight zones as printed, but for joy, whose weights on the forehead belong to the corners of the eyes.
TEST(RigLaws, EachEmotionHasItsRowOfTable81) {
    PosedRig posed(test::arkit_face());
    posed.with({{"joy", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0.9F, 0.9F));
    posed.with({{"surprise", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0.8F, 0.8F, 0.8F, 0.8F, 0, 0, 0, 0, 0, 0, 0, 0));
    posed.with({{"fear", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0.2F, 0.2F, 0.75F, 0.75F, 0.3F, 0.3F, 0, 0.6F, 0, 0, 0.2F, 0.2F));
    posed.with({{"anger", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0, 0, 0, 0, 0.8F, 0.8F, 1, 0, 0, 0, 0.25F, 0.25F))
        << "negative weights clamp to none";
    posed.with({{"disgust", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0, 0, 0, 0, 1, 1, 1, 0.5F, 0.3F, 0.3F, 0.8F, 0.8F));
    posed.with({{"sadness", 1}});
    EXPECT_THAT(posed.pose.wrinkles, ElementsAre(0.2F, 0.2F, 0.75F, 0.75F, 0, 0, 0.1F, 1, 0, 0, 0.3F, 0.3F));
    posed.with({{"surprise", 1}, {"disgust", 1}});
    EXPECT_FLOAT_EQ(posed.zone("foreheadInnerLeft"), 0.7F) << "negative weights take away";
    posed.with({{"anger", 1}, {"disgust", 1}});
    EXPECT_EQ(posed.zone("glabella"), 1) << "the sum is clamped";
}

TEST(RigLaws, SurprisePlusAngerLeavesTheForeheadWithoutWrinkles) {
    PosedRig posed(test::arkit_face());
    for (const float both : {0.25F, 0.5F, 1.0F}) {
        posed.with({{"surprise", both}, {"anger", both}});
        for (const std::string_view zone :
             {"foreheadOuterLeft", "foreheadOuterRight", "foreheadInnerLeft", "foreheadInnerRight"}) {
            EXPECT_NEAR(posed.zone(zone), 0, 1e-6F) << zone;
        }
        EXPECT_GT(posed.zone("glabella"), 0);
    }
}

TEST(RigLaws, ARecordedPerformanceWrinklesAndBlushesToo) {
    PosedRig posed(test::arkit_face());
    posed.with({{"browOuterUpLeft", 1}, {"noseSneerRight", 1}, {"mouthSmileLeft", 1}, {"mouthSmileRight", 1}});
    EXPECT_FLOAT_EQ(posed.zone("foreheadOuterLeft"), 0.8F);
    EXPECT_EQ(posed.zone("foreheadOuterRight"), 0);
    EXPECT_FLOAT_EQ(posed.zone("noseRight"), 1);
    EXPECT_FLOAT_EQ(posed.blood("joy"), 0.5F);
    EXPECT_EQ(posed.pose.hemoglobin_factor, 1) << "no emotion, no dilation";
    // On a face with split shapes each side tells its own.
    PosedRig split(test::split_face());
    split.with({{"browInnerUp_L", 1}});
    EXPECT_FLOAT_EQ(split.zone("foreheadInnerLeft"), 0.8F);
    EXPECT_EQ(split.zone("foreheadInnerRight"), 0);
    // An emotion's own row tells all of what it drives, and shapes set on top of it tell the rest.
    posed.with({{"disgust", 0.5F}});
    const float alone = posed.zone("noseLeft");
    posed.with({{"disgust", 0.5F}, {"noseSneerLeft", 0.2F}});
    EXPECT_FLOAT_EQ(posed.zone("noseLeft"), alone + 0.2F);
}

TEST(RigLaws, HemoglobinIsAffineAndScaledAsPublished) {
    PosedRig posed(test::arkit_face());
    posed.with({{"anger", 1}});
    EXPECT_EQ(posed.blood("anger"), 1);
    EXPECT_FLOAT_EQ(posed.pose.hemoglobin_factor, 1.27F);
    posed.with({{"fear", 1}});
    EXPECT_EQ(posed.blood("fear"), 1);
    EXPECT_FLOAT_EQ(posed.pose.hemoglobin_factor, 0.81F);
    posed.with({{"joy", 0.25F}});
    EXPECT_FLOAT_EQ(posed.blood("joy"), 0.25F);
    posed.with({{"anger", 1}, {"fear", 1}, {"exercise", 1}, {"joy", 1}});
    EXPECT_FLOAT_EQ(posed.blood("exercise"), 0.25F);
    EXPECT_FLOAT_EQ(posed.pose.hemoglobin_factor, 1 + 0.25F * (0.27F - 0.19F));
}

TEST(RigLaws, StatesMoveBloodAndLittleElse) {
    PosedRig posed(test::arkit_face());
    for (const std::string_view state : {"exercise", "alcohol", "blush", "pallor", "cold"}) {
        posed.with({{state, 1}});
        EXPECT_EQ(posed.blood(state), 1) << state;
        EXPECT_THAT(posed.pose.weights, Each(FloatNear(0, 0.2F))) << state;
        EXPECT_THAT(posed.pose.wrinkles, Each(FloatNear(0, 0.1F))) << state;
    }
}

TEST(RigLaws, ADuchenneSmileReachesTheEyesAndASocialOneDoesNot) {
    PosedRig posed(test::arkit_face());
    for (const std::string_view smile : {"joy", "duchenneSmile", "socialSmile"}) {
        posed.with({{smile, 1}});
        EXPECT_GT(posed.weight("mouthSmileLeft"), 0.5F) << smile;
        EXPECT_EQ(posed.weight("cheekSquintLeft") > 0.5F, smile != "socialSmile") << smile;
    }
}

TEST(RigLaws, OddNumbersAreClampedAsDocumented) {
    PosedRig posed(test::arkit_face());
    const float largest = std::numeric_limits<float>::max(), infinity = std::numeric_limits<float>::infinity();
    const Pose full = posed.with({{"joy", 1}, {"AU17", 1}, {"blush", 1}});
    expect_same(posed.with({{"joy", largest}, {"AU17", 7}, {"blush", 1e9F}}), full);
    const Pose rest = posed.rig.rest_pose();
    for (const float odd : {std::nanf(""), infinity, -infinity, -1.0F, -largest, 1e-42F, -1e-42F}) {
        expect_same(posed.with({{"joy", odd}, {"AU17", odd}, {"blush", odd}, {"laughter", odd}}), rest);
    }
    for (float& control : posed.controls) control = largest;
    posed.rig.evaluate(posed.controls, posed.pose);
    for (const float weight : posed.pose.weights) EXPECT_EQ(weight, largest_weight);
    for (const float share : posed.pose.hemoglobin) EXPECT_TRUE(std::isfinite(share));
}

TEST(RigLaws, WhatIsSetOnATargetStaysWhateverDrivesIt) {
    PosedRig posed(test::arkit_face());
    posed.with({{"mouthSmileLeft", 1.4F}, {"joy", 1}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 1.4F) << "beyond the range already: joy takes it no further";
    posed.with({{"mouthSmileLeft", -0.5F}, {"AU12_L", 0.25F}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), -0.25F);
    posed.with({{"joy", 1}, {"duchenneSmile", 1}, {"AU12", 1}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 1) << "what drives it takes it to 1";
}

TEST(RigLaws, EvaluateDoesNotAllocate) {
    PosedRig posed(test::split_face());
    std::size_t before = test::allocation_count();
    ::operator delete(::operator new(16));
    ASSERT_GT(test::allocation_count(), before) << "the counter does not count";
    for (float& control : posed.controls) control = 0.3F;
    before = test::allocation_count();
    posed.rig.evaluate(posed.controls, posed.pose);
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace blush
