// Which effects and bakers are studied: all of them, but for those that say why not.

#include "runtime/measure/studies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "runtime/bake/baker.h"
#include "runtime/frame/effect.h"
#include "runtime/measure/accuracy.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

std::set<std::string_view> names_of_all_that_is_studied() {
    std::set<std::string_view> names;
    for (const Effect* effect : effects()) names.insert(effect->name);
    for (const Baker* baker : bakers()) names.insert(baker->name);
    return names;
}

TEST(Studies, EveryEffectAndBakerHasOneOrSaysWhyNot) {
    for (const std::string_view name : names_of_all_that_is_studied()) {
        SCOPED_TRACE(name);
        const auto found = std::ranges::find(studied(), name, &Studied::name);
        ASSERT_NE(found, studied().end()) << "add it to runtime/measure/studies.cpp";
        EXPECT_NE(found->make == nullptr, found->why_none.empty());
        if (found->make == nullptr) {
            EXPECT_NE(found->why_none.find(' '), std::string_view::npos);
        }
    }
}

TEST(Studies, AreOfNothingThatIsNotThereAndOfNothingTwice) {
    const std::set<std::string_view> names = names_of_all_that_is_studied();
    std::set<std::string_view> seen;
    for (const Studied& what : studied()) {
        EXPECT_TRUE(names.contains(what.name)) << what.name << " is neither effect nor baker";
        EXPECT_TRUE(seen.insert(what.name).second) << what.name << " stands there twice";
    }
}

class Accuracy : public test::GlTest {};

TEST_F(Accuracy, AnEffectWithoutAStudySaysWhy) {
    const Face face = test::make_face({.targets = 1});
    for (const Studied& what : studied()) {
        if (what.make != nullptr) continue;
        AccuracyOptions options;
        options.effect = what.name;
        const Result<AccuracyReport> report = measure_accuracy(device_, face, options);
        ASSERT_FALSE(report) << what.name;
        EXPECT_EQ(report.error().message,
                  std::string(what.name) + " has no study, since " + std::string(what.why_none));
    }
}

TEST_F(Accuracy, EveryStudyThatATestFaceHasIsFiniteAndKnowsItsDefault) {
    // What a face has no maps, skin or joints for is no study of it; the surface's are always there.
    const Face face = test::make_face({.side = 8, .targets = 2, .normal_deltas = true, .joints = true});
    for (const std::string_view name : {"deformation", "normals", "skinning"}) {
        SCOPED_TRACE(name);
        const auto what = std::ranges::find(studied(), name, &Studied::name);
        ASSERT_NE(what, studied().end());
        const std::vector<Study> studies = what->make(device_, face, 1, true);
        ASSERT_FALSE(studies.empty());
        for (const Study& study : studies) {
            EXPECT_EQ(std::ranges::count_if(study.variants, &Variant::is_default), 1) << study.name;
            for (const Variant& variant : study.variants) {
                variant.run();
                const Variant::Error error = variant.error();
                EXPECT_TRUE(std::isfinite(error.mean) && std::isfinite(error.worst)) << variant.label;
            }
        }
    }
}

}  // namespace
}  // namespace blush
