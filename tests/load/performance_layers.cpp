/// Layers, loops, easings and markers of the JSON performance: what is read, and what it plays like.

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/motion/curve.h"
#include "rig/motion/performance.h"
#include "tests/load/performance_file.h"

namespace blush {
namespace {

using test::load_text;
using test::message_of;
using testing::ElementsAre;
using testing::IsEmpty;

Face face_with(const std::vector<std::string>& targets) {
    Face face;
    face.path = "face.glb";
    for (const std::string& name : targets) {
        face.targets.emplace_back();
        face.targets.back().name = name;
    }
    return face;
}

/// Plays a text on a face of the targets "a" and "b".
class Played {
public:
    explicit Played(const std::string& text) : rig_(face_with({"a", "b"})), pose_(rig_.rest_pose()) {
        Result<Performance> loaded = load_text(text);
        EXPECT_TRUE(loaded) << loaded.error().message;
        EXPECT_THAT(loaded->notes, IsEmpty());
        bound_.emplace_back(*std::move(loaded), rig_);
    }
    float at(float seconds, std::size_t control = 0, float below = 0) {
        std::vector<float> controls(rig_.control_names().size(), below);
        bound_.front().sample(seconds, controls, pose_);
        return controls[control];
    }
    const BoundPerformance& bound() const { return bound_.front(); }

private:
    Rig rig_;
    Pose pose_;
    std::vector<BoundPerformance> bound_;
};

std::string with(const std::string& inside) { return R"({"blush_performance": 1, )" + inside + "}"; }

TEST(PerformanceEasing, EachKeyEasesTheWayToTheNext) {
    Played played(with(R"("channels": {"a": {"interpolation": "linear", "keys": [
        [0, 0, "ease-in"], [1, 1, "ease-out"], [2, 0, "ease-in-out"], [3, 1, "step"], [4, 0], [5, 1]]}})"));
    for (float u = 0; u < 1; u += 1.0F / 16) {
        EXPECT_NEAR(played.at(u), u * u, 1e-6F);
        EXPECT_NEAR(played.at(1 + u), 1 - (2 * u - u * u), 1e-6F);
        EXPECT_NEAR(played.at(2 + u), u * u * (3 - 2 * u), 1e-6F);
        EXPECT_EQ(played.at(3 + u), 1);
        EXPECT_NEAR(played.at(4 + u), u, 1e-6F);
    }
    EXPECT_EQ(played.at(std::nextafter(4.0F, 0.0F)), 1) << "a step holds until the last moment before the next key";
    EXPECT_EQ(played.at(4), 0);
}

TEST(PerformanceEasing, NoEaseLeavesTheStretchBetweenItsKeys) {
    for (const char* ease : {"smooth", "linear", "step", "ease-in", "ease-out", "ease-in-out"}) {
        Played played(with(R"("channels": {"a": {"keys": [[0, 0.25, ")" + std::string(ease) + R"("], [2, 0.75]]}})"));
        float last = played.at(0);
        EXPECT_EQ(last, 0.25F) << ease;
        for (int i = 1; i <= 200; ++i) {
            const float value = played.at(static_cast<float>(i) / 100);
            EXPECT_GE(value, last - 1e-6F) << ease;
            last = value;
        }
        EXPECT_EQ(last, 0.75F) << ease;
    }
}

TEST(PerformanceLayers, AddAndOverrideInTheirOrder) {
    Played played(with(R"("channels": {"a": {"keys": [[0, 0.5]]}, "b": {"keys": [[0, 0.25]]}},
        "layers": [{"channels": {"a": {"keys": [[0, 0.25]]}}, "weight": 0.5},
                   {"mode": "override", "weight": 0.25, "channels": {"a": {"keys": [[0, 0.125]]}}},
                   {"mode": "override", "weight": 7, "start": 2, "channels": {"b": {"keys": [[0, 1], [1, 0]]}}}])"));
    EXPECT_FLOAT_EQ(played.at(0), std::lerp(0.5F + 0.5F * 0.25F, 0.125F, 0.25F));
    EXPECT_EQ(played.at(1.99F, 1), 0.25F) << "a layer that has not begun counts for nothing";
    EXPECT_EQ(played.at(2, 1), 1) << "an override goes no farther than its layer";
    EXPECT_EQ(played.at(99, 1), 0) << "holds after its last key";
    EXPECT_EQ(played.bound().duration_seconds(), 3);
}

TEST(PerformanceLayers, AWeightOfZeroLeavesTheBits) {
    Played plain(with(R"("channels": {"a": {"keys": [[0, 0.1], [1, 0.7]]}})"));
    for (const char* mode : {"add", "override"}) {
        Played layered(with(R"("channels": {"a": {"keys": [[0, 0.1], [1, 0.7]]}}, "layers": [{"mode": ")" +
                            std::string(mode) + R"(", "weight": 0, "channels": {"a": {"keys": [[0, 3]]}}}])"));
        for (float time = 0; time < 1.5F; time += 0.01F) ASSERT_EQ(plain.at(time), layered.at(time)) << mode;
    }
}

TEST(PerformanceLayers, AWeightCurveFadesALayerInWithoutAJump) {
    Played played(with(R"("channels": {"a": {"keys": [[0, 0.2]]}},
        "layers": [{"mode": "override", "channels": {"a": {"keys": [[0, 1]]}},
                    "weight": {"interpolation": "linear", "keys": [[1, 0], [2, 1], [3, 0]]}}])"));
    EXPECT_EQ(played.at(0.5F), 0.2F);
    EXPECT_FLOAT_EQ(played.at(1.5F), 0.6F);
    EXPECT_FLOAT_EQ(played.at(2), 1);
    EXPECT_EQ(played.at(3), 0.2F);
    for (float time = 0; time < 4; time += 1e-3F) {
        ASSERT_LT(std::abs(played.at(time + 1e-3F) - played.at(time)), 1e-3F) << time;
    }
}

TEST(PerformanceLoops, RoundsRepeatExactlyAndTheLastOneHolds) {
    const std::string keys = R"({"a": {"interpolation": "linear", "keys": [[0, 0], [0.5, 1]]}})";
    Played for_ever(with(R"("loop": true, "channels": )" + keys));
    Played thrice(with(R"("loop": 3, "length": 0.75, "channels": )" + keys));
    EXPECT_EQ(for_ever.bound().duration_seconds(), 0.5F);
    EXPECT_EQ(thrice.bound().duration_seconds(), 2.25F);
    for (float time = 0; time < 0.5F; time += 1.0F / 64) {
        for (int round = 1; round < 5; ++round) {
            EXPECT_EQ(for_ever.at(time), for_ever.at(time + 0.5F * static_cast<float>(round)));
        }
        EXPECT_EQ(thrice.at(time), thrice.at(time + 1.5F));
    }
    EXPECT_EQ(thrice.at(0.7F), 1) << "a round longer than its keys holds the last one";
    EXPECT_EQ(thrice.at(2.25F), 1);
    EXPECT_EQ(thrice.at(1e30F), 1);
    for (const float odd : {-1.0F, 0.0F, std::numeric_limits<float>::quiet_NaN()}) EXPECT_EQ(for_ever.at(odd), 0);
    EXPECT_TRUE(std::isfinite(for_ever.at(std::numeric_limits<float>::infinity())));
}

TEST(PerformanceLoops, ALayerLoopsByItself) {
    Played played(with(R"("channels": {}, "layers": [{"start": 1, "loop": 2, "channels":
        {"a": {"interpolation": "linear", "keys": [[0, 0], [1, 1]]}}}])"));
    EXPECT_EQ(played.at(0.9F), 0);
    EXPECT_EQ(played.at(1.25F), 0.25F);
    EXPECT_EQ(played.at(2.25F), 0.25F);
    EXPECT_EQ(played.at(3.25F), 1);
    EXPECT_EQ(played.bound().duration_seconds(), 3);
}

TEST(PerformanceMarkers, ComeInTheOrderOfTimeAndOnce) {
    const auto loaded = load_text(with(R"("channels": {}, "markers": [
        {"time": 2, "event": "wave", "text": "bye", "seconds": 0.5}, {"time": 0, "event": "start"},
        {"time": 1, "text": "thirty characters are read in 2"}])"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->markers.size(), 3U);
    EXPECT_EQ(loaded->markers[0].event, "start");
    EXPECT_NEAR(loaded->markers[1].text_seconds, 2, 0.1);
    EXPECT_EQ(loaded->markers[2].text, "bye");
    EXPECT_EQ(loaded->duration_seconds, 3.0F + 1.0F / 15);

    const BoundPerformance bound(*loaded, Rig(face_with({})));
    std::vector<std::string> heard;
    double before = -1;
    for (int step = 0; step <= 300; ++step) {
        const double now = step / 100.0;
        for (const Marker& marker : bound.markers_between(before, now)) heard.push_back(marker.event);
        before = now;
    }
    EXPECT_THAT(heard, ElementsAre("start", "", "wave"));
    EXPECT_TRUE(bound.markers_between(2, 1).empty());
}

TEST(PerformanceLayers, EveryFaultHasItsSentence) {
    const auto layer = [](const std::string& inside) { return with(R"("channels": {}, "layers": [)" + inside + "]"); };
    const std::vector<std::pair<std::string, std::string>> faults = {
        {with(R"("channels": {}, "layers": {})"), "layers must be an array, not object"},
        {layer("3"), "layers[0] must be an object, not number"},
        {layer("{}"), "layers[0]: the key 'channels' is missing"},
        {layer(R"({"mode": "mix", "channels": {}})"), "layers[0].mode: 'mix' is none of add, override"},
        {layer(R"({"weight": "1", "channels": {}})"), "layers[0].weight must be a number, not string"},
        {layer(R"({"weight": {"keys": []}, "channels": {}})"),
         "layers[0].weight.keys is empty; a channel needs at least one key"},
        {layer(R"({"start": -1, "channels": {}})"), "layers[0].start: -1 is less than 0 seconds"},
        {layer(R"({"loop": true, "channels": {"a": {"keys": [[0, 1]]}}})"),
         "layers[0].loop: a loop needs a length above 0 seconds: a second key, or 'length'"},
        {layer(R"({"channels": {"a": {"keys": [[0, 1, "bounce"]]}}})"),
         "layers[0].channels.a.keys[0][2]: 'bounce' is none of smooth, linear, step, ease-in, ease-out, ease-in-out"},
        {with(R"("channels": {"a": {"keys": [[0, 0], [1, 1]]}}, "loop": 0)"),
         "loop must be true, false or a whole number from 1 to 1000000, not 0"},
        {with(R"("channels": {}, "markers": [{"event": "x"}])"), "markers[0]: the key 'time' is missing"},
        {with(R"("channels": {}, "markers": [{"time": 1}])"), "markers[0]: needs an 'event', a 'text', or both"},
    };
    for (const auto& [text, message] : faults) EXPECT_EQ(message_of(text), message) << text;
}

TEST(PerformanceLayers, AMillionKeysLoadAndPlay) {
    std::string text = with(R"("channels": {"a": {"keys": [)");
    text.resize(text.size() - 1);
    constexpr int count = 1'000'000;
    for (int i = 0; i < count; ++i) {
        text += (i == 0 ? "[" : ",[") + std::to_string(i) + (i % 2 == 0 ? ",0]" : ",1]");
    }
    Played played(text + "]}}}");
    EXPECT_EQ(played.bound().duration_seconds(), count - 1);
    EXPECT_EQ(played.at(count - 1), 1);
    EXPECT_EQ(played.at(count / 2), 0);
}

}  // namespace
}  // namespace blush
