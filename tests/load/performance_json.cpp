#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/motion/curve.h"
#include "rig/names.h"
#include "tests/load/performance_file.h"

namespace blush {
namespace {

using test::load_text;
using test::message_of;
using testing::ElementsAre;
using testing::IsEmpty;

/// A performance of one channel "jawOpen" whose object has the given inside.
std::string jaw(const std::string& inside) {
    return R"({"blush_performance": 1, "channels": {"jawOpen": {)" + inside + "}}}";
}

float value_at(const Track& track, float time) {
    float out = -99;
    sample(track, time, {&out, 1});
    return out;
}

TEST(PerformanceJson, ReadsEveryInterpolation) {
    const auto loaded = load_text(R"(
        {"blush_performance": 1, "name": "all four", "channels": {
            "zeta": {"interpolation": "linear", "keys": [[0, 1], [2, 3]]},
            "alpha": {"interpolation": "step", "keys": [[0, 1], [2.5, 3]]},
            "cubic": {"interpolation": "cubic", "keys": [[0, 1, 8, 2], [1, 3, 4, 9]]},
            "smooth": {"interpolation": "smooth", "keys": [[0, 1], [1, 3]]},
            "default": {"keys": [[0, 1], [1, 3]]}}})");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->name, "all four");
    EXPECT_EQ(loaded->duration_seconds, 2.5F);
    EXPECT_THAT(loaded->notes, IsEmpty());
    ASSERT_EQ(loaded->channels.size(), 5U);
    EXPECT_EQ(loaded->channels[0].name, "zeta") << "channels stay in the order of the file";
    EXPECT_EQ(loaded->channels[0].track.interpolation, Interpolation::linear);
    EXPECT_THAT(loaded->channels[0].track.times_seconds, ElementsAre(0, 2));
    EXPECT_THAT(loaded->channels[0].track.values, ElementsAre(1, 3));
    EXPECT_EQ(loaded->channels[1].track.interpolation, Interpolation::step);
    EXPECT_EQ(loaded->channels[2].track.interpolation, Interpolation::cubic_spline);
    EXPECT_THAT(loaded->channels[2].track.values, ElementsAre(8, 1, 2, 4, 3, 9));
    EXPECT_EQ(loaded->channels[3].track.values, loaded->channels[4].track.values);
    EXPECT_EQ(loaded->channels[4].track.interpolation, Interpolation::cubic_spline);
}

TEST(PerformanceJson, SmoothTangentsAreThoseComputedByHand) {
    // Steps 1 and 2, slopes 1 and 0.5: weights 2 * 2 + 1 = 5 and 2 + 2 * 1 = 4; (5 + 4) / (5 / 1 + 4 / 0.5) = 9 / 13.
    const auto loaded = load_text(jaw(R"("keys": [[0, 0], [1, 1], [3, 2], [4, 0]])"));
    ASSERT_TRUE(loaded);
    const float slope = 9.0F / 13;
    EXPECT_THAT(loaded->channels[0].track.values, ElementsAre(0, 0, 0, slope, 1, slope, 0, 2, 0, 0, 0, 0));
}

TEST(PerformanceJson, SmoothNeverPassesBeyondItsKeys) {
    const auto loaded = load_text(
        jaw(R"("keys": [[0, 0], [0.1, 0.9], [1, 1], [1.01, 0.02], [1.02, 0], [3, 0], [3.5, 0.4], [3.6, 0.41]])"));
    ASSERT_TRUE(loaded);
    const Track& track = loaded->channels[0].track;
    for (std::size_t key = 0; key + 1 < track.times_seconds.size(); ++key) {
        const float low = std::min(track.values[3 * key + 1], track.values[3 * key + 4]);
        const float high = std::max(track.values[3 * key + 1], track.values[3 * key + 4]);
        float last = track.values[3 * key + 1];
        for (int i = 0; i <= 100; ++i) {
            const float time =
                std::lerp(track.times_seconds[key], track.times_seconds[key + 1], static_cast<float>(i) / 100);
            const float value = value_at(track, time);
            ASSERT_GE(value, low - 1e-6F) << time;
            ASSERT_LE(value, high + 1e-6F) << time;
            if (high == track.values[3 * key + 4]) {
                ASSERT_GE(value, last - 1e-6F) << "falls on the way up at " << time;
            }
            last = value;
        }
    }
}

TEST(PerformanceJson, UnknownKeysAreNotes) {
    const auto loaded = load_text(
        R"({"blush_performance": 1, "emotions": [], "channels": {"jawOpen": {"keys": [[0, 1]], "easing": 3}}, "by": "me"})");
    ASSERT_TRUE(loaded);
    EXPECT_THAT(loaded->notes, ElementsAre("channels.jawOpen: the key 'easing' is not known and counts for nothing",
                                           "the key 'emotions' is not known and counts for nothing",
                                           "the key 'by' is not known and counts for nothing"));
    EXPECT_EQ(loaded->channels.size(), 1U);
}

TEST(PerformanceJson, NoChannelsIsAStillNamedAfterTheFile) {
    const test::TemporaryFile file("empty_one.json", "\xEF\xBB\xBF \r\n{\"blush_performance\": 1, \"channels\": {}}");
    const auto loaded = load_performance(file.path());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->name, file.path().stem().string());
    EXPECT_EQ(loaded->duration_seconds, 0);
}

TEST(PerformanceJson, EveryFaultHasItsSentence) {
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"{}", "the key 'blush_performance' is missing at the top level"},
        {R"({"blush_performance": "1"})", "blush_performance must be a whole number, not string"},
        {R"({"blush_performance": 1.5})", "blush_performance must be a whole number, not number"},
        {R"({"blush_performance": 2, "channels": {}})", "blush_performance: version 2 is not known, only 1 is"},
        {R"({"blush_performance": 1})", "the key 'channels' is missing at the top level"},
        {R"({"blush_performance": 1, "name": 7, "channels": {}})", "name must be a string, not number"},
        {R"({"blush_performance": 1, "channels": []})", "channels must be an object, not array"},
        {R"({"blush_performance": 1, "channels": {"jawOpen": [[0, 1]]}})",
         "channels.jawOpen must be an object, not array"},
        {jaw(""), "channels.jawOpen: the key 'keys' is missing"},
        {jaw(R"("keys": 3)"), "channels.jawOpen.keys must be an array, not number"},
        {jaw(R"("keys": [])"), "channels.jawOpen.keys is empty; a channel needs at least one key"},
        {jaw(R"("keys": [[0, 1], 5])"), "channels.jawOpen.keys[1] must be an array, not number"},
        {jaw(R"("keys": [[0, 1, 2]])"), "channels.jawOpen.keys[0][2] must be a string, not number"},
        {jaw(R"("interpolation": "cubic", "keys": [[0, 1]])"),
         "channels.jawOpen.keys[0] must have 4 numbers (time, value, in-tangent, out-tangent), not 2"},
        {jaw(R"("keys": [[0, 1], [1, 1], [2, 1], [3, "x"]])"),
         "channels.jawOpen.keys[3][1] must be a number, not string"},
        {jaw(R"("keys": [[null, 1]])"), "channels.jawOpen.keys[0][0] must be a number, not null"},
        {jaw(R"("keys": [[0, 1e39]])"), "channels.jawOpen.keys[0][1]: 1e+39 is beyond the range of a float"},
        {jaw(R"("keys": [[-0.5, 1]])"), "channels.jawOpen.keys[0][0]: the time -0.5 is before 0"},
        {jaw(R"("keys": [[0, 1], [0.5, 1], [0.5, 2]])"),
         "channels.jawOpen.keys[2][0]: the time 0.5 does not come after that of the key before"},
        {jaw(R"("interpolation": 1, "keys": [[0, 1]])"), "channels.jawOpen.interpolation must be a string, not number"},
        {jaw(R"("interpolation": "bezier", "keys": [[0, 1]])"),
         "channels.jawOpen.interpolation: 'bezier' is none of smooth, linear, step, ease-in, ease-out, ease-in-out, "
         "cubic"},
        {R"({"blush_performance": 1, "channels": {"a": {"keys": [[0, 1]]}, "a": {"keys": [[0, 2]]}}})",
         "the key 'a' is there twice in one object"},
        {"{\"layers\": " + std::string(100, '['), "nested more than 16 deep"},
        {"{\n  \"blush_performance\": 1,\n  \"channels\": {,}\n}",
         "line 3, column 16: not valid JSON: unexpected ','; expected string literal"},
        {"{\"blush_performance\": 1", "line 1, column 24: not valid JSON: unexpected end of input; expected '}'"},
        {"{\"blush_performance\": 1}\nx",
         "line 2, column 1: not valid JSON: invalid literal; last read: '1}<U+000A>x'; expected end of input"},
        {"{\"blush_performance\": 1,\n \"x\": 1e999}", "line 2, column 7: '1e999' is out of range"},
    };
    for (const auto& [text, message] : faults) EXPECT_EQ(message_of(text), message) << text;

    std::string many = "{\"blush_performance\": 1";
    for (int i = 0; i < 17'000; ++i) many += ",\"k" + std::to_string(i) + "\": 0";
    EXPECT_EQ(message_of(many + "}"), "an object has more than 16384 keys");
    EXPECT_EQ(message_of("{" + std::string((64U << 20) + (1U << 20), ' ')),
              "a JSON performance may have 64 MiB, this has 65");
}

TEST(PerformanceJson, EveryTruncationHasASentence) {
    const std::string whole =
        R"({"blush_performance": 1, "name": "é", "channels": {"a": {"keys": [[0, 1], [1.5e0, -2]]}}})";
    ASSERT_EQ(message_of(whole), "(loads)");
    for (std::size_t length = 1; length < whole.size(); ++length) {
        EXPECT_THAT(message_of(whole.substr(0, length)), testing::StartsWith("line 1, column ")) << length;
    }
}

TEST(PerformanceFile, WhatIsNotAFileHasASentence) {
    const auto missing = load_performance("/no/such/file.json");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "/no/such/file.json: there is no such file");
    const auto folder = load_performance(std::filesystem::temp_directory_path());
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().message, std::filesystem::temp_directory_path().string() + ": is not a regular file");
    const auto device = load_performance("/dev/zero");
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().message, "/dev/zero: is not a regular file");
    EXPECT_EQ(message_of(""), "the file is empty");
    EXPECT_EQ(message_of(" \r\n\t"), "the file is empty");
    EXPECT_EQ(message_of("\xEF\xBB\xBF"), "the file is empty");

    const test::TemporaryFile sparse("too_long.csv", "Timecode");
    std::filesystem::resize_file(sparse.path(), 513ULL << 20);
    const auto too_long = load_performance(sparse.path());
    ASSERT_FALSE(too_long);
    EXPECT_EQ(too_long.error().message, sparse.path().string() + ": a performance may have 512 MiB, this has 513");
}

TEST(FirstLight, IsWhatItSaysItIs) {
    const auto loaded =
        load_performance(std::filesystem::path(BLUSH_SOURCE_DIR) / "assets/performances/first_light.json");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_THAT(loaded->notes, IsEmpty());
    EXPECT_EQ(loaded->duration_seconds, 12.0F);
    const std::vector<std::string> shapes(arkit_names.begin(), arkit_names.end());
    const auto curve = [&](std::string_view name) -> const Track& {
        const auto found = std::find_if(loaded->channels.begin(), loaded->channels.end(),
                                        [&](const PerformanceChannel& c) { return c.name == name; });
        EXPECT_NE(found, loaded->channels.end()) << name;
        return found->track;
    };
    for (const PerformanceChannel& channel : loaded->channels) {
        const bool is_angle = !find_name(channel.name, shapes);
        const float low = is_angle ? -0.25F : 0, high = is_angle ? 0.25F : 1;
        float most = 0;
        for (float time = 0; time <= 12; time += 1.0F / 120) {
            const float value = value_at(channel.track, time);
            ASSERT_GE(value, low) << channel.name << " at " << time;
            ASSERT_LE(value, high) << channel.name << " at " << time;
            if (channel.name.starts_with("head")) {
                ASSERT_LE(std::abs(value), 0.2F) << channel.name << " at " << time;
            }
            most = std::max(most, std::abs(value));
        }
        EXPECT_GT(most, 0.01F) << channel.name << " does nothing";
    }
    // The eyes turn as their lids and the skin around them say: the scale is that of real recordings, 0.6 radians of
    // yaw and 0.55 of pitch for a shape of 1.
    for (float time = 0; time <= 12; time += 1.0F / 120) {
        const auto at = [&](std::string_view name) { return value_at(curve(name), time); };
        ASSERT_NEAR(at("leftEyeYaw"), 0.6F * (at("eyeLookOutLeft") - at("eyeLookInLeft")), 1e-3F) << time;
        ASSERT_NEAR(at("rightEyeYaw"), 0.6F * (at("eyeLookInRight") - at("eyeLookOutRight")), 1e-3F) << time;
        ASSERT_NEAR(at("leftEyePitch"), 0.55F * (at("eyeLookDownLeft") - at("eyeLookUpLeft")), 1e-3F) << time;
        ASSERT_NEAR(at("rightEyePitch"), 0.55F * (at("eyeLookDownRight") - at("eyeLookUpRight")), 1e-3F) << time;
        // ARKit's mouthClose shuts the lips over an open jaw; more of it than of jawOpen pushes the lips into each
        // other.
        ASSERT_LE(at("mouthClose"), at("jawOpen") + 1e-3F) << time;
    }
}

}  // namespace
}  // namespace blush
