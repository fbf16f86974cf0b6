/// What scripts do to a face over time.

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rig/count_allocations.h"
#include "tests/script/script_run.h"

namespace blush {
namespace {

using test::error_of;
using test::ScriptRun;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Script, FeelGoesToItsValueInItsTime) {
    ScriptRun run("feel('joy', 0.8, {over = 1, ease = 'linear'})");
    EXPECT_EQ(run.to(0).value("joy"), 0);
    EXPECT_FLOAT_EQ(run.to(0.5).value("joy"), 0.4F);
    EXPECT_FLOAT_EQ(run.to(1).value("joy"), 0.8F);
    EXPECT_FLOAT_EQ(run.to(9).value("joy"), 0.8F);
    EXPECT_EQ(run.script->settled_seconds(), 1);
    EXPECT_TRUE(run.script->ended());
}

TEST(Script, FeelTurnsAroundFromWhereItIsWithoutAJump) {
    ScriptRun run("feel('joy', 1, {over = 1}) wait(0.5) feel('joy', 0, {over = 2})");
    run.to(0);
    float last = run.value("joy");
    for (double time = 0.01; time < 3; time += 0.01) {
        const float value = run.to(time, 0.01).value("joy");
        EXPECT_LT(std::abs(value - last), 0.02F) << time;
        last = value;
    }
    EXPECT_EQ(last, 0);
}

TEST(Script, WaitsAddUpExactlyWhateverTheStep) {
    const std::string text = R"(
        for i = 1, 40 do feel("joy", i % 2, {over = 0.03, ease = "linear"}) wait(0.05) end
        set("jawOpen", now()))";
    for (const double step : {1.0 / 24, 1.0 / 60, 1.0 / 1000, 0.7}) {
        ScriptRun run(text);
        run.to(3, step);
        EXPECT_EQ(run.error, "");
        EXPECT_NEAR(run.value("jawOpen"), 2, 1e-6) << step;
        EXPECT_EQ(run.value("joy"), 0) << step;
    }
    // In the middle, too, the face is where it is at that moment and not where a step has left it.
    ScriptRun coarse(text), fine(text);
    EXPECT_NEAR(coarse.to(0.915, 0.3).value("joy"), fine.to(0.915, 1e-3).value("joy"), 1e-5F);
    EXPECT_NEAR(coarse.value("joy"), 0.5F, 1e-3F);
}

TEST(Script, BlendLetsGoOfWhatItDoesNotName) {
    ScriptRun run(R"(feel({joy = 0.5, sadness = 0.2}, {over = 0}) set("jawOpen", 0.1) wait(1)
               wait(blend({anger = 0.7}, {over = 1})) set("blush", now()))");
    run.to(0.5);
    EXPECT_EQ(run.value("joy"), 0.5F);
    run.to(3);
    EXPECT_EQ(run.value("joy"), 0);
    EXPECT_EQ(run.value("sadness"), 0);
    EXPECT_FLOAT_EQ(run.value("anger"), 0.7F);
    EXPECT_EQ(run.value("jawOpen"), 0.1F) << "set() is not a feeling";
    EXPECT_EQ(run.value("blush"), 2) << "blend() gives the time that it takes";
}

TEST(Script, WhatItDoesNotTouchKeepsItsBits) {
    ScriptRun run("feel('joy', 1, {over = 0}) wait(1) release('joy', {over = 1})");
    run.below.assign(run.below.size(), 0.3F);
    run.to(0.5);
    const std::vector<float> controls = run.controls();
    EXPECT_EQ(controls[0], 1);
    for (std::size_t i = 1; i < controls.size(); ++i) EXPECT_EQ(controls[i], 0.3F);
    EXPECT_FLOAT_EQ(run.to(1.5).value("joy"), 0.65F);
    EXPECT_EQ(run.to(2.5).value("joy"), 0.3F);
}

TEST(Script, GetSeesWhatLiesBelowAndWhatItHolds) {
    ScriptRun run(
        "print(get('joy'), get('anger')) feel('joy', 1, {over = 1, ease = 'linear'}) wait(0.5) print(get('joy'))");
    run.below[2] = 0.25F;
    EXPECT_EQ(run.to(1).error, "");
    EXPECT_THAT(run.printed, ElementsAre("0.0\t0.25", "0.5"));
}

TEST(Script, TasksEventsAndRepetitions) {
    ScriptRun run(R"(
        local function note(what) print(string.format("%.2f %s", now(), what)) end
        on("poke", function(text) note("poked: " .. text) wait(0.1) note("calm") end)
        local beat = every(0.5, function() note("beat") end)
        start(function(word) wait(0.25) note(word) emit("done", 7) end, "side")
        start(function() note("heard " .. wait_for("done")) end)
        start(function() assert(wait_for("never", 0.3) == nil) note("gave up") end)
        wait(1.2) stop(beat))");
    run.script->emit("poke", "cheek", 0.7);
    run.script->emit("nobody", "", 0.8);
    EXPECT_EQ(run.to(3).error, "");
    EXPECT_THAT(run.printed, ElementsAre("0.00 beat", "0.25 side", "0.25 heard 7", "0.30 gave up", "0.50 beat",
                                         "0.70 poked: cheek", "0.80 calm", "1.00 beat"));
    EXPECT_FALSE(run.script->ended()) << "on() still waits for a poke";
}

TEST(Script, EveryDoesNotBeginAgainWhileItIsAtIt) {
    ScriptRun run("every(0.1, function() print(now()) wait(0.25) end)");
    run.to(0.65);
    EXPECT_THAT(run.printed, ElementsAre("0.0", HasSubstr("0.3"), HasSubstr("0.6")));
}

TEST(Script, AnErrorStopsItAndLeavesTheFaceWhereItWas) {
    ScriptRun run(
        "feel('joy', 1, {over = 1, ease = 'linear'}) wait(0.5)\nset('joy', 0) set('anger', 1) error('broken')");
    run.to(2, 1.0 / 64);
    EXPECT_EQ(run.error, "folder/test.lua:2: broken");
    const float before = 0.5F - 1.0F / 64;
    EXPECT_FLOAT_EQ(run.value("joy"), before) << "as before the step that failed";
    EXPECT_EQ(run.value("anger"), 0);
    EXPECT_TRUE(run.script->step(1, run.below)) << "the error is told once";
    EXPECT_FLOAT_EQ(run.value("joy"), before);
    EXPECT_TRUE(run.script->stopped_by_error());
}

TEST(Script, ReplaysToTheSameBits) {
    const std::string text = R"(
        every(0.3, function() feel({joy = random(), sadness = random()}, {over = 0.1 + random()}) end)
        while true do wait(random() * 0.2) set("jawOpen", random()) end)";
    ScriptRun first(text), second(text), again(text);
    again.to(1.3);
    ASSERT_TRUE(again.script->restart());
    for (double time = 0; time < 4; time += 0.25) {
        const std::vector<float> values = first.to(time).controls();
        ASSERT_EQ(values, second.to(time).controls()) << time;
        ScriptRun fresh(text);
        while (again.script->now_seconds() < time) ASSERT_TRUE(again.script->step(1.0 / 64, again.below));
        if (time == 0) {
            ASSERT_TRUE(again.script->step(0, again.below));
        }
        ASSERT_EQ(values, again.controls()) << time;
    }
}

TEST(Script, SayLookAndBlink) {
    ScriptRun run(
        "say('Oh.', {over = 0.5}) look(20, -5, {distance = 2}) blink() wait(1) look() wait(say('fifteen letters') - "
        "1)");
    run.to(0.25);
    EXPECT_EQ(run.script->caption(), "Oh.");
    EXPECT_TRUE(run.script->gaze().wished);
    EXPECT_NEAR(run.script->gaze().yaw_radians, 0.349, 1e-3);
    EXPECT_NEAR(run.script->gaze().pitch_radians, -0.0873, 1e-3);
    EXPECT_EQ(run.script->gaze().distance_metres, 2);
    EXPECT_EQ(run.script->blinks_wished(), 1U);
    run.to(1.5);
    EXPECT_EQ(run.script->caption(), "fifteen letters");
    EXPECT_FALSE(run.script->gaze().wished);
    run.to(5);
    EXPECT_EQ(run.script->caption(), "");
    EXPECT_EQ(run.script->captions().size(), 2U);
}

TEST(Script, PlaysPerformances) {
    ScriptOptions options;
    options.find_performance = [](const std::string& name) -> Result<Performance> {
        if (name != "wave") return Error{"there is no " + name};
        Performance wave;
        wave.duration_seconds = 1;
        wave.channels.push_back({"jawOpen", {Interpolation::linear, 1, {0, 1}, {0, 1}}});
        return wave;
    };
    ScriptRun run(
        "print(play('wave', {fade = 0}), get('joy')) wait(2) play('wave', {weight = 0.5, fade = 0, speed = 0.5})",
        options);
    EXPECT_FLOAT_EQ(run.to(0.5).value("jawOpen"), 0.5F);
    EXPECT_EQ(run.to(1.5).value("jawOpen"), 0) << "over";
    EXPECT_FLOAT_EQ(run.to(3).value("jawOpen"), 0.25F);
    EXPECT_EQ(run.error, "");
    EXPECT_THAT(run.printed, ElementsAre("1.0\t0.0"));
    EXPECT_EQ(error_of("play('dance')", options), "folder/test.lua:1: play: there is no dance");
    EXPECT_EQ(error_of("play('dance')"), "folder/test.lua:1: play: there are no performances to play here");
}

TEST(Script, EveryMisuseHasItsSentence) {
    const std::vector<std::pair<const char*, const char*>> faults = {
        {"feel('joyy', 1)", "feel: the face has no control 'joyy' (did you mean 'joy'?)"},
        {"feel(3, 1)", "feel: the name of a control must be a string, not number"},
        {"feel('joy')", "feel: the value of a control must be a number, not no value"},
        {"feel('joy', 0/0)", "feel: the value of a control is not finite"},
        {"feel('joy', 1, {ovr = 2})", "feel: there is no option 'ovr' (there are: over, ease)"},
        {"feel('joy', 1, 2)", "feel: options are a table, like {over = 1.5}, not a number"},
        {"feel('joy', 1, {over = -1})", "feel: over must be 0 to 1000000 seconds"},
        {"feel('joy', 1, {ease = 'bounce'})",
         "feel: ease 'bounce' is none of smooth, linear, step, ease-in, ease-out, ease-in-out"},
        {"feel({joy = 1, Joy = 0})", "feel: two of the names mean 'joy'"},
        {"blend('joy')", "blend: takes a table, like blend({joy = 0.3, sadness = 0.5}, {over = 2})"},
        {"wait('x')", "wait: the time must be a number, not string"},
        {"wait(1e9)", "wait: the time must be 0 to 1000000 seconds"},
        {"wait_for('')", "wait_for: the name of an event is empty"},
        {"on('x', 3)", "on: a function is needed, not a number"},
        {"every(0, print)", "every: the time must be 0.001 seconds at least"},
        {"start(3)", "start: a function is needed, not a number"},
        {"for i = 1, 1e6 do start(wait, 1) end", "start: more than 256 tasks at once"},
        {"for i = 1, 1e6 do on('x', print) end", "on: more than 256 of on() and every()"},
        {"look(200, 0)", "look: angles must be -90 to 90 degrees"},
        {"table.sort({2, 1}, function() wait(1) end)",
         "wait: cannot wait inside of a sort's or a metatable's function"},
    };
    for (const auto& [text, message] : faults) EXPECT_EQ(error_of(text), "folder/test.lua:1: " + std::string(message));
}

TEST(Script, HugeAndOddValuesStayFinite) {
    ScriptRun run("set('joy', 1e300) set('anger', -1e300) feel('blush', 1e-320, {over = 1e-300}) wait(1e-9)");
    EXPECT_EQ(run.to(1).error, "");
    for (const float value : run.controls()) EXPECT_TRUE(std::isfinite(value));
}

TEST(Script, ManyTasksOfManyEventsStayWithinTheirBounds) {
    ScriptRun run("for i = 1, 200 do on('x', function() wait(10) end) end");
    run.to(0.1);
    for (int i = 0; i < 100; ++i) run.script->emit("x", "", 0.2);
    EXPECT_THAT(run.to(1).error, HasSubstr("more than 256 tasks at once"));
}

TEST(Script, ApplyDoesNotAllocate) {
    ScriptRun run("feel({joy = 1, sadness = 0.5}, {over = 3}) while true do wait(0.1) end");
    run.to(1);
    std::vector<float> values = run.below;
    run.script->apply(values);
    const std::size_t before = test::allocation_count();
    for (int i = 0; i < 100; ++i) run.script->apply(values);
    EXPECT_EQ(test::allocation_count(), before);
}

TEST(Script, FilesThatAreNone) {
    const Rig rig(test::face_with({}));
    const auto missing = Script::load("/no/such/script.lua", rig);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "/no/such/script.lua: there is no such file");
    const auto device = Script::load("/dev/zero", rig);
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().message, "/dev/zero: is not a regular file");
}

}  // namespace
}  // namespace blush
