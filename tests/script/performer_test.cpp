/// Timeline, script, life and blood together; the shipped scripts and performances.

#include "runtime/script/performer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/names.h"
#include "runtime/files/performance/performance_file.h"
#include "runtime/script/lint_script.h"
#include "tests/load/performance_file.h"
#include "tests/script/script_run.h"

namespace blush {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> arkit() { return {arkit_names.begin(), arkit_names.end()}; }

class PerformerTest : public testing::Test {
protected:
    std::optional<Script> script(const std::string& text) {
        Result<Script> created = Script::create(text, "test.lua", rig);
        EXPECT_TRUE(created) << created.error().message;
        return *std::move(created);
    }
    std::vector<float> controls_at(Performer& performer, double seconds) {
        std::vector<float> controls(rig.control_names().size());
        EXPECT_TRUE(performer.seek(seconds));
        performer.write(controls, pose);
        return controls;
    }
    float at(Performer& performer, double seconds, const char* name) {
        return controls_at(performer, seconds)[static_cast<std::size_t>(*rig.find(name))];
    }
    BoundPerformance jaw(float from, float to) const {
        Performance performance;
        performance.duration_seconds = 1;
        performance.channels.push_back({"jawOpen", {Interpolation::linear, 1, {0, 1}, {from, to}}});
        return BoundPerformance(std::move(performance), rig);
    }
    const Rig rig{test::face_with(arkit())};
    Pose pose = rig.rest_pose();
};

TEST_F(PerformerTest, NothingGivesTheBaseBitForBit) {
    PerformerParts parts;
    for (std::size_t i = 0; i < rig.control_names().size(); ++i) parts.base.push_back(0.01F * static_cast<float>(i));
    const std::vector<float> base = parts.base;
    Performer performer(rig, std::move(parts));
    EXPECT_TRUE(performer.still());
    EXPECT_EQ(controls_at(performer, 3.7), base);
}

TEST_F(PerformerTest, PartsComeInTheirOrder) {
    PerformerParts parts;
    parts.timeline = jaw(0, 1);
    parts.script = script(
        "wait(0.5) print(get('jawOpen')) feel('jawOpen', 0, {over = 0}) wait(0.25) release('jawOpen', {over = 0})");
    Performer performer(rig, std::move(parts));
    EXPECT_FLOAT_EQ(at(performer, 0.25, "jawOpen"), 0.25F);
    EXPECT_EQ(at(performer, 0.6, "jawOpen"), 0) << "the script holds it";
    EXPECT_FLOAT_EQ(at(performer, 0.9, "jawOpen"), 0.9F) << "and has let it go";
}

TEST_F(PerformerTest, AMomentDoesNotDependOnTheWayThere) {
    const auto make = [&] {
        PerformerParts parts;
        parts.timeline = jaw(0.1F, 0.9F);
        parts.script = script(
            "every(0.3, function() feel({joy = random(), blush = random()}, {over = random()}) look(random(-20, 20), "
            "3) end)");
        parts.life = LifeSettings{};
        parts.blood_speed = 1;
        return Performer(rig, std::move(parts));
    };
    Performer played = make(), asked = make(), back = make();
    for (int frame = 0; frame <= 90; ++frame) controls_at(played, frame / 30.0);
    controls_at(back, 7.3);
    const std::vector<float> there = controls_at(asked, 3);
    EXPECT_EQ(controls_at(played, 3), there);
    EXPECT_EQ(controls_at(back, 3), there) << "to an earlier time from the beginning";
    EXPECT_EQ(played.blood()->state().shares, asked.blood()->state().shares);
    EXPECT_EQ(back.blood()->state().factor, asked.blood()->state().factor);
    EXPECT_FALSE(played.still());
}

TEST_F(PerformerTest, MarkersAndOutsideEventsReachTheScript) {
    Performance performance;
    performance.duration_seconds = 2;
    performance.markers = {{.time_seconds = 0.5F, .event = "laugh", .text = "ha", .text_seconds = 1}};
    PerformerParts parts;
    parts.timeline.emplace(std::move(performance), rig);
    parts.events = {{.time_seconds = 1, .event = "poke", .text = {}}};
    parts.script = script("on('laugh', function(t) set('joy', #t) end) on('poke', function() set('anger', now()) end)");
    Performer performer(rig, std::move(parts));
    EXPECT_EQ(at(performer, 0.4, "joy"), 0);
    EXPECT_EQ(at(performer, 0.6, "joy"), 2);
    EXPECT_EQ(performer.caption(), "ha");
    EXPECT_EQ(at(performer, 1.6, "anger"), 1);
    EXPECT_EQ(performer.caption(), "");
    EXPECT_EQ(at(performer, 0.6, "anger"), 0) << "again from the beginning";
}

TEST_F(PerformerTest, AScriptThatFailsIsToldOnceAndTheRestGoesOn) {
    PerformerParts parts;
    parts.timeline = jaw(0, 1);
    parts.script = script("feel('joy', 1, {over = 1, ease = 'linear'}) wait(0.5)\nerror('broken')");
    Performer performer(rig, std::move(parts));
    const Status sought = performer.seek(0.8);
    ASSERT_FALSE(sought);
    EXPECT_EQ(sought.error().message, "test.lua:2: broken");
    EXPECT_NEAR(at(performer, 0.9, "joy"), 0.5F, 0.01F);
    EXPECT_FLOAT_EQ(at(performer, 0.9, "jawOpen"), 0.9F);
    EXPECT_FALSE(performer.find_end(10));
}

TEST_F(PerformerTest, FindsItsEnd) {
    const auto end_of = [&](const std::string& text) {
        PerformerParts parts;
        parts.script = script(text);
        Performer performer(rig, std::move(parts));
        const auto end = performer.find_end(20);
        EXPECT_TRUE(end);
        return *end;
    };
    EXPECT_EQ(end_of("wait(1) feel('joy', 1, {over = 2})"), 3);
    EXPECT_EQ(end_of("every(1, blink)"), std::nullopt);
    EXPECT_EQ(end_of("on('poke', blink)"), 0);
    EXPECT_EQ(end_of("while true do wait(0.1) end"), std::nullopt);
}

TEST_F(PerformerTest, SlowBloodFollowsTheStateAndNotTheExpression) {
    PerformerParts parts;
    parts.script = script("feel({joy = 0.3, blush = 0.5}, {over = 0})");
    parts.blood_speed = 1;
    Performer performer(rig, std::move(parts));
    std::vector<float> controls = controls_at(performer, 7);
    rig.evaluate(controls, pose);
    const Pose at_once = pose;
    performer.blood()->apply(pose);
    for (std::size_t i = 0; i < rig.hemoglobin_maps().size(); ++i) {
        const float share = rig.hemoglobin_maps()[i] == "blush" ? 1 - std::exp(-1.0F) : 1;
        EXPECT_NEAR(pose.hemoglobin[i], share * at_once.hemoglobin[i], 1e-3F) << rig.hemoglobin_maps()[i];
    }
    EXPECT_LT(pose.hemoglobin_factor, at_once.hemoglobin_factor);
    EXPECT_EQ(pose.weights, at_once.weights);
}

TEST_F(PerformerTest, OddTimesAreHarmless) {
    PerformerParts parts;
    parts.timeline = jaw(0, 1);
    parts.life = LifeSettings{};
    Performer performer(rig, std::move(parts));
    for (const double odd : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 0.0}) {
        EXPECT_EQ(at(performer, odd, "jawOpen"), 0) << odd;
    }
}

std::vector<std::filesystem::path> shipped(const char* folder, const char* ending) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(BLUSH_SOURCE_DIR) / "assets" / folder)) {
        if (entry.path().extension() == ending) files.push_back(entry.path());
    }
    return files;
}

TEST_F(PerformerTest, ShippedScriptsHaveNothingOddAndMoveTheFace) {
    const auto files = shipped("scripts", ".lua");
    EXPECT_GE(files.size(), 6U);
    for (const std::filesystem::path& file : files) {
        const auto findings = lint_script(file, rig);
        ASSERT_TRUE(findings) << findings.error().message;
        for (const ScriptFinding& finding : *findings)
            ADD_FAILURE() << file << ":" << finding.line << ": " << finding.sentence;

        Result<Script> loaded = Script::load(file, rig);
        ASSERT_TRUE(loaded) << loaded.error().message;
        PerformerParts parts;
        parts.script = *std::move(loaded);
        parts.events = {{.time_seconds = 1, .event = "poke", .text = {}}};
        Performer performer(rig, std::move(parts));
        float most = 0;
        for (double time = 0; time < 12; time += 0.5) {
            for (const float value : controls_at(performer, time)) most = std::max(most, std::abs(value));
        }
        EXPECT_GT(most, 0.2F) << file;
        EXPECT_LE(most, 1) << file;
    }
}

TEST_F(PerformerTest, ShippedPerformancesMatchTheFace) {
    for (const std::filesystem::path& file : shipped("performances", ".json")) {
        Result<Performance> performance = load_performance(file);
        ASSERT_TRUE(performance) << performance.error().message;
        EXPECT_THAT(performance->notes, IsEmpty()) << file;
        const BoundPerformance bound(*std::move(performance), rig);
        EXPECT_THAT(bound.unmatched_channels(), IsEmpty()) << file;
    }
}

TEST_F(PerformerTest, LintFindsWhatIsOdd) {
    const auto findings_of = [&](const std::string& text) {
        const test::TemporaryFile file("odd.lua", text);
        const auto findings = lint_script(file.path(), rig);
        EXPECT_TRUE(findings);
        std::vector<std::string> sentences;
        for (const ScriptFinding& f : *findings) sentences.push_back(std::to_string(f.line) + ": " + f.sentence);
        return sentences;
    };
    EXPECT_THAT(findings_of("feel('joy', 1)"), IsEmpty());
    EXPECT_THAT(findings_of("feel('joy', 1"), ElementsAre("1: ')' expected near <eof>"));
    EXPECT_THAT(findings_of("\nfeel('joyy', 1)"), ElementsAre("2: there is no control 'joyy' (did you mean 'joy'?)"));
    EXPECT_THAT(findings_of("if false then\n  feel(\"angr\", 1) end -- feel('nothing')\nset('joy', 1)"),
                ElementsAre("2: there is no control 'angr' (did you mean 'anger'?)"));
    EXPECT_THAT(findings_of("on('poke', function()\n feel('joy', 1) error('late') end)"), ElementsAre("2: late"));
    EXPECT_THAT(findings_of("while true do end"), ElementsAre(HasSubstr("1: the script did not come to a wait()")));
    EXPECT_THAT(findings_of("feel('joy', 1) for i = 1, 150000 do end"),
                ElementsAre(HasSubstr("of the 200000 instructions that it may")));
    EXPECT_THAT(findings_of("wait(1)"), ElementsAre("0: nothing moves in the first minute"));
    EXPECT_FALSE(lint_script("/no/such/script.lua", rig));
}

}  // namespace
}  // namespace blush
