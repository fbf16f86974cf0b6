// Promise 2: every hard case of every effect, with every choice of every setting, leaves only finite values behind.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "runtime/effect.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

/// One effect's hard case under one choice of one setting (of any effect).
struct Case {
    const Effect* effect;
    const HardCase* hard;
    std::string setting, choice;
};

std::vector<Case> all_cases() {
    std::vector<Case> cases;
    for (const Effect* effect : effects()) {
        for (const HardCase& hard : effect->hard_cases) {
            for (const Effect* other : effects()) {
                for (const Setting& setting : other->settings) {
                    const std::string name = std::string(other->name) + "." + std::string(setting.name);
                    for (const std::string_view choice : setting.choices) {
                        cases.push_back({effect, &hard, name, std::string(choice)});
                    }
                }
            }
        }
    }
    return cases;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    std::string name = std::string(info.param.effect->name) + "_" + std::string(info.param.hard->name) + "_" +
                       info.param.setting + "_" + info.param.choice;
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return name;
}

class HardCases : public test::GlTest, public testing::WithParamInterface<Case> {};

TEST_P(HardCases, StayFinite) {
    const auto& [effect, hard, setting, choice] = GetParam();
    SCOPED_TRACE(std::string(hard->name) + ": " + std::string(hard->expectation));
    for (const bool normal_deltas : {false, true}) {
        Face face = test::make_face({.side = 14,
                                     .targets = 2,
                                     .normal_deltas = normal_deltas,
                                     .tangent_deltas = normal_deltas,
                                     .seam = true,
                                     .normal_map = true,
                                     .joints = effect->name == "skinning"});
        hard->make(face);
        const Status valid = validate(face);
        ASSERT_TRUE(valid) << valid.error().message;
        const auto targets = static_cast<std::ptrdiff_t>(face.targets.size());
        Character character = make_character(std::move(face));
        ASSERT_TRUE(character.set(setting, choice));
        std::fill_n(character.controls().begin(), targets, hard->weight);

        const Offscreen display = make_offscreen(64, 64), linear = make_offscreen(64, 64, Output::linear_hdr);
        for (int frame = 0; frame < 2; ++frame) test::draw(character, display);
        const Image radiance = test::draw(character, linear);
        for (const float value : radiance.floats) ASSERT_TRUE(std::isfinite(value));
        View forced = test::framed_view(character, display);
        forced.force_effects = true;
        test::draw(character, display, forced);

        const Character::Surface surface = character.read_deformed();
        for (std::size_t v = 0; v < surface.normals.size(); ++v) {
            ASSERT_NEAR(glm::length(glm::dvec3(surface.normals[v])), 1, 1e-5) << "normal of vertex " << v;
            ASSERT_NEAR(glm::length(glm::dvec3(surface.tangents[v])), 1, 1e-5) << "tangent of vertex " << v;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryEffect, HardCases, testing::ValuesIn(all_cases()), name_of);

// Views that a host may ask for by mistake.

class HardViews : public test::GlTest {};

TEST_F(HardViews, ACameraInsideOrOnTheFaceStaysFinite) {
    Character character = make_character(test::make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(64, 64);
    for (const float distance : {0.0F, 1e-3F, 0.6F, 1e6F}) {
        View view = test::framed_view(character, offscreen);
        OrbitCamera camera = character.framing(1);
        camera.distance = distance == 0 ? 1e-6F : distance;
        camera.pitch_radians = 9;  // clamped below the pole
        view.camera = camera.camera(1);
        test::draw(character, offscreen, view);
    }
}

TEST_F(HardViews, AnEmptyProjectionStaysFinite) {
    Character character = make_character(test::make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(64, 64);
    View view = test::framed_view(character, offscreen);
    view.camera.clip_from_view = glm::mat4(0);
    test::draw(character, offscreen, view);
}

}  // namespace
}  // namespace blush
