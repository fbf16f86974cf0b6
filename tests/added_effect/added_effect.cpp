// A shading effect comes in from its own file and one line of the registry: settings, predicate, permutations,
// uniforms, texture units and reasons follow.

#include <algorithm>

#include "runtime/frame/device_state.h"
#include "runtime/settings.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

class AddedEffect : public test::GlTest {
protected:
    AddedEffect() : character_(make_character(skin())), offscreen_(make_offscreen(96, 96)) {}

    static Face skin() {
        Face face = test::make_face();
        for (Material& material : face.materials) material.skin = true;
        return face;
    }
    Image drawn(std::string_view amount) {
        const Status set = character_.set("frost.amount", amount);
        EXPECT_TRUE(set) << set.error().message;
        return test::draw(character_, offscreen_);
    }
    EffectReport reported() const {
        for (const EffectReport& report : character_.report().characters[0].effects) {
            if (report.effect == "frost") return report;
        }
        ADD_FAILURE() << "no report of frost";
        return {};
    }
    static double blue_over_red(const Image& image) {
        double red = 0, blue = 0;
        for (std::size_t p = 0; p < image.bytes.size(); p += 4) {
            red += image.bytes[p];
            blue += image.bytes[p + 2];
        }
        return blue / red;
    }

    Portrait character_;
    Offscreen offscreen_;
};

TEST_F(AddedEffect, ShadesWhereItIsOn) {
    const Image warm = drawn("0");
    EXPECT_FALSE(reported().on);
    EXPECT_EQ(reported().reason, "frost.amount is 0");
    const Image half = drawn("0.5");
    EXPECT_TRUE(reported().on);
    const Image cold = drawn("1");
    EXPECT_GT(blue_over_red(half), 1.02 * blue_over_red(warm));
    EXPECT_GT(blue_over_red(cold), 1.02 * blue_over_red(half));
    EXPECT_EQ(drawn("0").bytes, warm.bytes);
}

TEST_F(AddedEffect, ItsSettingIsKnownByName) {
    EXPECT_FALSE(character_.set("frost.amount", "2"));
    EXPECT_FALSE(character_.set("frost.colour", "blue"));
    const Result<SettingOwner> owner = EffectSettings::owner_of("frost.amount");
    ASSERT_TRUE(owner);
    EXPECT_EQ(*owner, SettingOwner::character);
}

TEST_F(AddedEffect, AShaderThatDoesNotCompileIsReportedAndDrawsNothing) {
    // A driver's own message about it is no fault here.
    device_ = *Device::headless(false);
    character_ = make_character(device_, skin());
    offscreen_ = make_offscreen(96, 96);
    const Image warm = drawn("0.5");
    ASSERT_TRUE(character_.set("frost.text", "bad"));
    for (int again = 0; again < 2; ++again) {
        const FrameReport& report = character_.draw(test::framed_view(character_, offscreen_));
        ASSERT_TRUE(report.failure);
        EXPECT_NE(report.failure->find("shader draw/face.frag does not compile"), std::string::npos) << *report.failure;
        EXPECT_EQ(offscreen_.read().bytes, warm.bytes) << "what was there stays";
    }
    ASSERT_TRUE(character_.set("frost.text", "good"));
    EXPECT_EQ(drawn("0.5").bytes, warm.bytes);
    EXPECT_FALSE(character_.report().failure);
}

TEST_F(AddedEffect, AFrameThatWasNotDrawnIsNotRemembered) {
    device_ = *Device::headless(false);
    Face its = test::make_face({.targets = 4, .normal_deltas = true});
    for (Material& material : its.materials) material.skin = true;
    for (const char* mode : {"none", "smaa_t2x"}) {
        character_ = make_character(device_, its);
        offscreen_ = make_offscreen(96, 96);
        ASSERT_TRUE(character_.set("antialiasing.mode", mode));
        test::set_weights(character_, {1, 0, 0, 0});
        drawn("0.5");
        // New weights come with a frame that fails: its surface was never made.
        test::set_weights(character_, {0, 0, 1, 1});
        ASSERT_TRUE(character_.set("frost.text", "bad"));
        ASSERT_TRUE(character_.draw(test::framed_view(character_, offscreen_)).failure);
        ASSERT_TRUE(character_.set("frost.text", "good"));
        const Image after = drawn("0.5");
        Portrait fresh = make_character(device_, its);
        ASSERT_TRUE(fresh.set("antialiasing.mode", mode));
        ASSERT_TRUE(fresh.set("frost.amount", "0.5"));
        test::set_weights(fresh, {0, 0, 1, 1});
        EXPECT_EQ(after.bytes, test::draw(fresh, offscreen_).bytes) << mode;
    }
}

TEST_F(AddedEffect, IsLeftOutWithAReasonWhereNoTextureUnitIsLeft) {
    // Of the effects with textures, shadows and the surface's reflection come after it and go first.
    const Image warm = drawn("0");
    DeviceInfo& info = device_.state().info;
    const int units = info.texture_units;
    EXPECT_GE(units, 16);
    info.texture_units = 0;
    const Image none = drawn("1");
    EXPECT_FALSE(reported().on);
    EXPECT_EQ(reported().reason, "all texture units of the device are taken");
    EXPECT_LE(blue_over_red(none), 1.02 * blue_over_red(warm));
    info.texture_units = units;
    EXPECT_GT(blue_over_red(drawn("1")), 1.02 * blue_over_red(warm));
}

}  // namespace
}  // namespace blush
