// Promise 2: every hard case of every effect, with every choice of its settings, and of every baker leaves only finite
// values behind.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runtime/bake/baker.h"
#include "runtime/frame/effect.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

struct Case {
    std::string_view of;
    const Effect* effect;  ///< null: a baker's, whose settings are no frame's (hard_bakes.cpp has them)
    const HardCase* hard;
};

std::vector<Case> all_cases() {
    std::vector<Case> cases;
    for (const Effect* effect : effects()) {
        for (const HardCase& hard : effect->hard_cases) cases.push_back({effect->name, effect, &hard});
    }
    for (const Baker* baker : bakers()) {
        for (const HardCase& hard : baker->hard_cases) cases.push_back({baker->name, nullptr, &hard});
    }
    return cases;
}

/// Calls visit(setting, value) for every choice and both ends of every number among an effect's settings, one at a time
/// beside defaults; and once for the defaults alone, with an empty name.
template <class Visit>
void each_setting_value(const Effect* effect, Visit visit) {
    visit(std::string(), std::string());
    if (effect == nullptr) return;
    for (const Setting& setting : effect->settings) {
        const std::string name = std::string(effect->name) + "." + std::string(setting.name);
        for (const std::string_view choice : setting.choices) visit(name, std::string(choice));
        if (!setting.choices.empty()) continue;
        visit(name, std::to_string(setting.lowest));
        visit(name, std::to_string(setting.highest));
    }
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    std::string name = std::string(info.param.of) + "_" + std::string(info.param.hard->name);
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return name;
}

class HardCases : public test::GlTest, public testing::WithParamInterface<Case> {
protected:
    /// Draws in every way and reads back; all that comes out must be finite and all directions of unit length.
    void expect_sound(Face face, const HardCase& hard, const std::string& setting, const std::string& value) {
        const auto targets = static_cast<std::ptrdiff_t>(face.targets.size());
        Portrait character = make_character(std::move(face));
        if (!setting.empty()) {
            ASSERT_TRUE(character.set(setting, value));
        }
        std::fill_n(character.controls().begin(), targets, hard.weight);

        const Offscreen display = make_offscreen(64, 64), linear = make_offscreen(64, 64, Output::linear_hdr);
        ViewFrame display_view = test::framed_view(character, display),
                  linear_view = test::framed_view(character, linear);
        if (hard.look != nullptr) {
            hard.look(display_view);
            hard.look(linear_view);
        }
        for (int frame = 0; frame < 2; ++frame) test::draw(character, display, display_view);
        const Image radiance = test::draw(character, linear, linear_view);
        for (const float texel : radiance.floats) ASSERT_TRUE(std::isfinite(texel));
        display_view.force_effects = true;
        test::draw(character, display, display_view);

        const Scene::Surface surface = character.read_deformed();
        for (std::size_t v = 0; v < surface.normals.size(); ++v) {
            ASSERT_NEAR(glm::length(glm::dvec3(surface.normals[v])), 1, 1e-5) << "normal of vertex " << v;
            ASSERT_NEAR(glm::length(glm::dvec3(surface.tangents[v])), 1, 1e-5) << "tangent of vertex " << v;
        }
    }
};

TEST_P(HardCases, StayFinite) {
    const Effect* effect = GetParam().effect;
    const HardCase* hard = GetParam().hard;
    SCOPED_TRACE(std::string(hard->name) + ": " + std::string(hard->expectation));
    for (const bool normal_deltas : {false, true}) {
        // The same to what only reads the surface.
        if (normal_deltas && (effect == nullptr || effect->stage != Stage::surface)) break;
        Face face = test::make_face({.side = 14,
                                     .targets = 2,
                                     .normal_deltas = normal_deltas,
                                     .tangent_deltas = normal_deltas,
                                     .seam = true,
                                     .normal_map = true,
                                     .joints = GetParam().of == "skinning"});
        hard->make(face);
        const Status valid = validate(face);
        ASSERT_TRUE(valid) << valid.error().message;
        each_setting_value(effect, [&](const std::string& setting, const std::string& value) {
            SCOPED_TRACE(setting + "=" + value);
            expect_sound(face, *hard, setting, value);
        });
    }
}

INSTANTIATE_TEST_SUITE_P(EveryEffect, HardCases, testing::ValuesIn(all_cases()), name_of);

// Views that a host may ask for by mistake.

class HardViews : public test::GlTest {};

TEST_F(HardViews, ACameraInsideOrOnTheFaceStaysFinite) {
    Portrait character = make_character(test::make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(64, 64);
    for (const float distance : {0.0F, 1e-3F, 0.6F, 1e6F}) {
        ViewFrame view = test::framed_view(character, offscreen);
        OrbitCamera camera = character.framing(1);
        camera.distance = distance == 0 ? 1e-6F : distance;
        camera.pitch_radians = 9;  // clamped below the pole
        view.camera = camera.camera(1);
        test::draw(character, offscreen, view);
    }
}

TEST_F(HardViews, AnEmptyProjectionStaysFinite) {
    Portrait character = make_character(test::make_face({.targets = 1}));
    const Offscreen offscreen = make_offscreen(64, 64);
    ViewFrame view = test::framed_view(character, offscreen);
    view.camera.clip_from_view = glm::mat4(0);
    test::draw(character, offscreen, view);
}

}  // namespace
}  // namespace blush
