// In-betweens, correctives, limits, and what check() refuses.

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rig/controls/named_face.h"

namespace blush {
namespace {

using test::named_face;
using test::PosedRig;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(InBetweens, FadeFromOneToTheNext) {
    PosedRig posed(named_face({"jawOpen", "jawOpen_25", "jawOpen_75"}));
    const auto weights = [&](float jaw) { return posed.with({{"jawOpen", jaw}}).weights; };
    EXPECT_THAT(weights(0), ElementsAre(0, 0, 0));
    EXPECT_THAT(weights(0.125F), ElementsAre(0, 0.5F, 0));
    EXPECT_THAT(weights(0.25F), ElementsAre(0, 1, 0));
    EXPECT_THAT(weights(0.5F), ElementsAre(0, 0.5F, 0.5F));
    EXPECT_THAT(weights(0.75F), ElementsAre(0, 0, 1));
    EXPECT_THAT(weights(0.875F), ElementsAre(0.5F, 0, 0.5F));
    EXPECT_THAT(weights(1), ElementsAre(1, 0, 0));
    EXPECT_THAT(weights(1.5F), ElementsAre(1.5F, 0, 0));
    EXPECT_THAT(weights(-0.5F), ElementsAre(-0.5F, 0, 0));
    posed.with({{"jawOpen", 0.25F}, {"jawOpen_25", 0.5F}});
    EXPECT_EQ(posed.weight("jawOpen_25"), 1.5F) << "a value set on the in-between itself comes on top";
}

TEST(Correctives, VanishWhenAnyDriverDoes) {
    const Face face = named_face({"a", "b", "fix", "fixMin"});
    RigDescription description = default_description(face);
    description.correctives = {{.target = "fix", .drivers = {"a", "b"}, .rule = CorrectiveRule::product, .weight = 1},
                               {"fixMin", {"a", "b"}, CorrectiveRule::minimum, 0.5F}};
    ASSERT_TRUE(check(description, face));
    PosedRig posed(face, description);
    for (const float other : {0.0F, 0.5F, 1.0F, -1.0F, 20.0F}) {
        for (const float gone : {0.0F, -0.5F, -900.0F}) {
            posed.with({{"a", gone}, {"b", other}});
            EXPECT_EQ(posed.weight("fix"), 0);
            EXPECT_EQ(posed.weight("fixMin"), 0);
            posed.with({{"b", gone}, {"a", other}});
            EXPECT_EQ(posed.weight("fix"), 0);
        }
    }
    posed.with({{"a", 0.5F}, {"b", 0.75F}});
    EXPECT_EQ(posed.weight("fix"), 0.375F);
    EXPECT_EQ(posed.weight("fixMin"), 0.25F);
    posed.with({{"a", 4}, {"b", 0.75F}, {"fix", -0.25F}});
    EXPECT_EQ(posed.weight("fix"), 0.5F) << "drivers count up to 1; the target's own value stays";
}

TEST(Correctives, ReadWhatDrivesTheirDrivers) {
    const Face face = named_face({"jawOpen", "mouthSmileLeft", "jawOpen_mouthSmileLeft", "extra"});
    RigDescription description = default_description(face);
    description.correctives.push_back({"extra", {"jawOpen_mouthSmileLeft", "AU12"}});
    ASSERT_TRUE(check(description, face));
    PosedRig posed(face, description);
    posed.with({{"AU27", 0.5F}, {"AU12", 0.5F}});
    EXPECT_EQ(posed.weight("jawOpen_mouthSmileLeft"), 0.25F);
    EXPECT_EQ(posed.weight("extra"), 0.125F) << "correctives may drive correctives";
}

TEST(Limits, HoldWhatIsSetOrOnlyWhatDrives) {
    const Face face = named_face({"mouthClose", "jawOpen", "mouthSmileLeft"});
    RigDescription description = default_description(face);
    description.limits = {{.control = "mouthClose", .low = 0, .high = 1, .with = "jawOpen", .holds_own = true},
                          {.control = "mouthSmileLeft", .low = -0.25F, .high = 0.5F, .with = "", .holds_own = false}};
    ASSERT_TRUE(check(description, face));
    PosedRig posed(face, description);
    posed.with({{"mouthClose", 1}, {"jawOpen", 0.25F}});
    EXPECT_EQ(posed.weight("mouthClose"), 0.25F);
    posed.with({{"mouthClose", 1}});
    EXPECT_EQ(posed.weight("mouthClose"), 0);
    posed.with({{"joy", 1}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 0.5F);
    posed.with({{"mouthSmileLeft", 0.75F}, {"joy", 1}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 0.75F);
}

TEST(NamesTell, InBetweensAndCorrectivesWhereThereIsNoDoubt) {
    const auto found = [](const std::vector<std::string>& names) {
        const Face face = named_face(names);
        const RigDescription description = default_description(face);
        EXPECT_TRUE(check(description, face)) << check(description, face).error().message;
        std::vector<std::string> result;
        for (const InBetween& in_between : description.in_betweens) {
            result.push_back(in_between.target + " " + std::to_string(static_cast<int>(100 * in_between.at + 0.5F)));
        }
        for (const Corrective& corrective : description.correctives) {
            std::string text = corrective.target + ":";
            for (const std::string& driver : corrective.drivers) text += " " + driver;
            result.push_back(text);
        }
        return result;
    };
    EXPECT_THAT(found({"jaw", "jaw_50", "jaw_05"}), ElementsAre("jaw_50 50", "jaw_05 5"));
    EXPECT_THAT(found({"jaw", "jaw_50", "jaw_51"}), IsEmpty()) << "numbers of copies";
    EXPECT_THAT(found({"jaw", "jaw_5"}), IsEmpty());
    EXPECT_THAT(found({"jaw", "jaw_00"}), IsEmpty());
    EXPECT_THAT(found({"jaw", "jaw_050"}), IsEmpty());
    EXPECT_THAT(found({"jaw_50"}), IsEmpty()) << "of nothing";
    EXPECT_THAT(found({"jaw", "jaw_50", "jaw_50_25"}), ElementsAre("jaw_50 50"));
    EXPECT_THAT(found({"a", "b", "a_b"}), ElementsAre("a_b: a b"));
    EXPECT_THAT(found({"a", "b", "a_b", "a_b"}), ElementsAre("a_b: a b")) << "a face with a name twice";
    EXPECT_THAT(found({"mouthSmile_L", "mouthSmile_R", "mouthSmile_L_mouthSmile_R"}),
                ElementsAre("mouthSmile_L_mouthSmile_R: mouthSmile_L mouthSmile_R"));
    EXPECT_THAT(found({"a", "b", "c", "a_b", "a_b_c"}), ElementsAre("a_b: a b", "a_b_c: a b c"));
    EXPECT_THAT(found({"a", "a_a"}), IsEmpty()) << "one driver twice";
    EXPECT_THAT(found({"a", "x_b", "a_x", "b", "a_x_b"}), IsEmpty()) << "a and x_b, or a_x and b";
    EXPECT_THAT(found({"", "_", "__", "a", "_a", "a_"}), IsEmpty());
    EXPECT_THAT(found({"a", std::string(100'000, '_')}), IsEmpty());
}

/// The sentence that check() has for a change of the default description.
template <class Change>
std::string refusal(Change change) {
    const Face face = named_face({"jawOpen", "mouthSmileLeft", "mouthSmileRight", "fix", "fix2"});
    RigDescription description = default_description(face);
    change(description);
    const Status status = check(description, face);
    return status ? "(good)" : status.error().message;
}

TEST(Check, TheLibraryIsGoodOnAnyFace) {
    for (const Face& face : {test::arkit_face(), test::split_face(), named_face({}), named_face({"joy", "AU1", "x"}),
                             named_face({"a", "a", "mouthSmile_L", "mouthSmileLeft"})}) {
        const Status status = check(default_description(face), face);
        EXPECT_TRUE(status) << status.error().message;
    }
}

TEST(Check, EveryFaultHasItsSentence) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto emotion = [](std::vector<Drive> drives) {
        return [drives](RigDescription& d) { d.expressions.push_back({"pride", ControlKind::emotion, "", drives}); };
    };
    EXPECT_EQ(refusal(emotion({{"jawOpne", 1}})),
              "emotions.pride.drives.jawOpne: there is no control 'jawOpne' (did you mean 'jawOpen'?)");
    EXPECT_EQ(refusal(emotion({{"tongueOut", 1}})), "(good)") << "ARKit has it, though this face has not";
    EXPECT_EQ(refusal(emotion({{"joy", nan}})), "emotions.pride.drives.joy: it must be a number from -100 to 100");
    EXPECT_EQ(refusal(emotion({{"joy", 1}, {"Joy", 1}})), "emotions.pride.drives.Joy: it is there twice");
    EXPECT_EQ(refusal(emotion({{"pride", 1}})), "drivers: 'pride' drives itself ('pride' > 'pride')");
    EXPECT_EQ(refusal([](RigDescription& d) { d.expressions.push_back(d.expressions[0]); }),
              "action_units.AU1: there is another control of this name");
    EXPECT_EQ(refusal([](RigDescription& d) {
                  d.expressions.push_back({"", ControlKind::state, "", {}});
              }),
              "states: a name is empty");
    EXPECT_EQ(refusal([](RigDescription& d) {
                  d.expressions.push_back({"a1", ControlKind::emotion, "", {{"a2", 1}}});
                  d.expressions.push_back({"a2", ControlKind::emotion, "", {{"a1", 1}}});
              }),
              "drivers: 'a1' drives itself ('a1' > 'a2' > 'a1')");

    const auto in_between = [](std::vector<InBetween> list) {
        return [list](RigDescription& d) { d.in_betweens = list; };
    };
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", 0.5F}})), "(good)");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", 1}})), "in_betweens[0].at: it must be between 0 and 1");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", nan}})), "in_betweens[0].at: it must be between 0 and 1");
    EXPECT_EQ(refusal(in_between({{"joy", "fix", 0.5F}})), "in_betweens[0].shape: 'joy' is not a target");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "wat", 0.5F}})), "in_betweens[0].target: there is no control 'wat'");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", 0.5F}, {"jawOpen", "fix2", 0.5F}})),
              "in_betweens[1].at: the shape has an in-between there already");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", 0.5F}, {"mouthSmileLeft", "fix", 0.5F}})),
              "in_betweens[1].target: it is an in-between already");
    EXPECT_EQ(refusal(in_between({{"jawOpen", "fix", 0.5F}, {"fix", "fix2", 0.5F}})),
              "in_betweens[0].target: 'fix' has in-betweens itself");

    const auto corrective = [](std::vector<Corrective> list) {
        return [list](RigDescription& d) { d.correctives = list; };
    };
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen", "AU12"}}})), "(good)");
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen"}}})), "correctives[0].drivers: a corrective needs two or more");
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen", "JawOpen"}}})), "correctives[0].drivers[1]: it is there twice");
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen", "mouthSmiel_L"}}})),
              "correctives[0].drivers[1]: there is no control 'mouthSmiel_L' (did you mean 'mouthSmileLeft'?)");
    EXPECT_EQ(refusal(corrective({{"AU12", {"jawOpen", "AU1"}}})), "correctives[0].target: 'AU12' is not a target");
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen", "fix"}}})), "drivers: 'fix' drives itself ('fix' > 'fix')");
    EXPECT_EQ(refusal(corrective({{"fix", {"jawOpen", "fix2"}}, {"fix2", {"jawOpen", "fix"}}})),
              "drivers: 'fix' drives itself ('fix' > 'fix2' > 'fix')");

    const auto limit = [](Limit one) { return [one](RigDescription& d) { d.limits = {one}; }; };
    EXPECT_EQ(refusal(limit({"jawOpen", 0.5F, 1, "", true})),
              "limits.jawOpen.low: it must be a number from -1000 to 0");
    EXPECT_EQ(refusal(limit({"jawOpen", 0, nan, "", true})), "limits.jawOpen.high: it must be a number from 0 to 1000");
    EXPECT_EQ(refusal(limit({"jawOpen", 0, 1, "jawOpen", true})),
              "drivers: 'jawOpen' drives itself ('jawOpen' > 'jawOpen')");

    EXPECT_EQ(refusal([](RigDescription& d) { d.wrinkles[0].weights.pop_back(); }),
              "wrinkles.weights.joy: it must have one weight for each of the 12 zones, not 11");
    EXPECT_EQ(refusal([&](RigDescription& d) { d.wrinkles[0].weights[3] = nan; }),
              "wrinkles.weights.joy[3]: it must be a number from -100 to 100");
    EXPECT_EQ(refusal([](RigDescription& d) { d.wrinkles.push_back(d.wrinkles[1]); }),
              "wrinkles.weights.surprise: it is there twice");
    EXPECT_EQ(refusal([](RigDescription& d) { d.wrinkle_zones[1].low = 0.5F; }),
              "wrinkles.zones[1].low: it must be a number from -100 to 0");
    EXPECT_EQ(refusal([](RigDescription& d) { d.hemoglobin[0].map = "rash"; }),
              "hemoglobin.weights.joy.maps: there is no map 'rash'");
    EXPECT_EQ(refusal([](RigDescription& d) { d.hemoglobin[0].share = -1; }),
              "hemoglobin.weights.joy.maps.joy: it must be a number from 0 to 100");
    EXPECT_EQ(refusal([](RigDescription& d) { d.hemoglobin[0].factor = 0; }),
              "hemoglobin.weights.joy.factor: it must be a number from 0.01 to 100");
}

}  // namespace
}  // namespace blush
