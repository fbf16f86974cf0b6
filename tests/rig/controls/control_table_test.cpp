// Which controls a face gets, and what names mean on it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rig/controls/named_face.h"

namespace blush {
namespace {

using test::PosedRig;
using testing::ElementsAre;
using testing::IsEmpty;

ControlKind kind_of(const Rig& rig, std::string_view name) { return rig.info(rig.find(name).value()).kind; }

TEST(Controls, OnAFaceWithArkitNamesTheyAreTheFacesOwn) {
    const Rig rig(test::arkit_face());
    for (const std::string_view name : arkit_names) EXPECT_EQ(kind_of(rig, name), ControlKind::target) << name;
    EXPECT_THAT(rig.unmatched_arkit(), IsEmpty());
    EXPECT_THAT(rig.unmatched_drives(), IsEmpty());
    EXPECT_EQ(kind_of(rig, "headYaw"), ControlKind::angle);
    EXPECT_EQ(kind_of(rig, "AU12"), ControlKind::action_unit);
    EXPECT_EQ(kind_of(rig, "AU12_L"), ControlKind::action_unit);
    EXPECT_EQ(rig.find("AU12L"), rig.find("AU12_L"));
    EXPECT_EQ(rig.find("au12_left"), rig.find("AU12_L"));
    EXPECT_EQ(kind_of(rig, "Joy"), ControlKind::emotion);
    EXPECT_EQ(kind_of(rig, "shySmile"), ControlKind::compound);
    EXPECT_EQ(kind_of(rig, "blush"), ControlKind::state);
}

TEST(Controls, KindsComeInTheirOrder) {
    const Rig rig(test::split_face());
    ControlKind last = ControlKind::target;
    for (std::size_t i = 0; i < rig.control_names().size(); ++i) {
        const ControlKind kind = rig.info(static_cast<ControlId>(i)).kind;
        EXPECT_GE(kind, last) << rig.control_names()[i];
        last = kind;
    }
    EXPECT_EQ(last, ControlKind::state);
}

TEST(Controls, TheCommonFaceSetOfFacsIsThere) {
    const Rig rig(test::arkit_face());
    for (const int unit : {1,  2,  4,  5,  6,  7,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 22, 23, 24,
                           25, 26, 27, 28, 43, 45, 46, 51, 52, 53, 54, 55, 56, 57, 58, 61, 62, 63, 64}) {
        EXPECT_EQ(kind_of(rig, "AU" + std::to_string(unit)), ControlKind::action_unit) << unit;
    }
}

TEST(Controls, SplitShapesAnswerToTheirArkitName) {
    PosedRig posed(test::split_face());
    EXPECT_EQ(kind_of(posed.rig, "browInnerUp"), ControlKind::arkit);
    EXPECT_EQ(kind_of(posed.rig, "mouthSmileLeft"), ControlKind::target);
    EXPECT_THAT(posed.rig.unmatched_arkit(), ElementsAre("tongueOut"));
    EXPECT_EQ(posed.rig.find("tongueOut"), std::nullopt);
    posed.with({{"browInnerUp", 0.75F}, {"cheekPuff", 0.5F}});
    EXPECT_EQ(posed.weight("browInnerUp_L"), 0.75F);
    EXPECT_EQ(posed.weight("browInnerUp_R"), 0.75F);
    EXPECT_EQ(posed.weight("cheekPuff_L"), 0.5F);
    EXPECT_EQ(posed.weight("cheekPuff_R"), 0.5F);
    posed.with({{"AU1_L", 0.5F}});
    EXPECT_EQ(posed.weight("browInnerUp_L"), 0.5F);
    EXPECT_EQ(posed.weight("browInnerUp_R"), 0);
}

TEST(Controls, AShapeWithoutSidesTakesHalfFromEither) {
    PosedRig posed(test::named_face({"mouthSmile", "Brow_Down", "jawLeft"}));
    EXPECT_EQ(kind_of(posed.rig, "mouthSmileLeft"), ControlKind::arkit);
    EXPECT_EQ(kind_of(posed.rig, "jawLeft"), ControlKind::target);
    EXPECT_EQ(posed.rig.find("mouthLeft"), std::nullopt) << "a direction, not a side of the mouth";
    posed.with({{"mouthSmileLeft", 1}});
    EXPECT_EQ(posed.weight("mouthSmile"), 0.5F);
    posed.with({{"mouthSmileLeft", 1}, {"mouthSmileRight", 1}});
    EXPECT_EQ(posed.weight("mouthSmile"), 1);
    posed.with({{"AU4", 1}});
    EXPECT_EQ(posed.weight("Brow_Down"), 1);
}

TEST(Controls, PartsOfAFaceDoWhatTheyCanAndTheRestIsNamed) {
    PosedRig posed(test::named_face({"jawOpen", "mouthSmile_L"}));
    posed.with({{"laughter", 1}});
    EXPECT_FLOAT_EQ(posed.weight("jawOpen"), 0.3F);
    EXPECT_EQ(posed.weight("mouthSmile_L"), 1);
    EXPECT_EQ(posed.rig.unmatched_arkit().size(), 50U);
    EXPECT_THAT(posed.rig.unmatched_drives(), testing::Contains("AU12: mouthSmileRight"));
    EXPECT_THAT(posed.rig.unmatched_drives(), testing::Contains("AU18: mouthPucker"));
}

TEST(Controls, TheFacesOwnNameTakesThePlaceOfAnExpression) {
    PosedRig posed(test::named_face({"Joy", "mouthSmileLeft", "AU4"}));
    EXPECT_EQ(kind_of(posed.rig, "joy"), ControlKind::target);
    EXPECT_TRUE(posed.rig.is(*posed.rig.find("joy"), ControlKind::emotion));
    EXPECT_FALSE(posed.rig.is(*posed.rig.find("mouthSmileLeft"), ControlKind::emotion));
    posed.with({{"joy", 1}});
    EXPECT_EQ(posed.weight("Joy"), 1);
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 0) << "the sculpted joy is all of it";
    EXPECT_EQ(posed.blood("joy"), 1) << "and colour follows it";
    posed.with({{"anger", 1}});
    EXPECT_EQ(posed.weight("AU4"), 1) << "emotions drive a face's own action units";
}

TEST(Controls, MouthCloseIsDrivenNoFurtherThanTheJawIsOpen) {
    const Face face = test::arkit_face();
    RigDescription description = default_description(face);
    description.expressions.push_back({"hum", ControlKind::emotion, "", {{"mouthClose", 1}, {"jawOpen", 0.25F}}});
    PosedRig posed(face, description);
    posed.with({{"hum", 1}});
    EXPECT_EQ(posed.weight("mouthClose"), 0.25F);
    posed.with({{"mouthClose", 1}});
    EXPECT_EQ(posed.weight("mouthClose"), 1) << "what is set on a target stays";
}

TEST(Controls, EveryTargetWithinReachIsNamed) {
    const Rig rig(test::named_face({"mouthSmileLeft", "mouthSmileRight", "jawOpen", "jawOpen_50"}));
    EXPECT_THAT(rig.reach(*rig.find("AU12")), ElementsAre(0, 1));
    EXPECT_THAT(rig.reach(*rig.find("AU27")), ElementsAre(2, 3));
    EXPECT_THAT(rig.reach(*rig.find("laughter")), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(rig.reach(*rig.find("jawOpen_50")), ElementsAre(3));
    EXPECT_THAT(rig.reach(*rig.find("headYaw")), IsEmpty());
}

}  // namespace
}  // namespace blush
