// Rig descriptions from files.

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/files/rig_description_file.h"
#include "tests/load/performance_file.h"
#include "tests/rig/controls/named_face.h"

namespace blush {
namespace {

using testing::HasSubstr;

Face small_face() { return test::named_face({"jawOpen", "mouthSmileLeft", "mouthSmileRight", "fix", "jawOpen_50"}); }

Result<RigDescription> load_rig(std::string_view text, const Face& face) {
    const test::TemporaryFile file("face.rig.json", text);
    return load_rig_description(file.path(), face);
}

/// The message without the file that must open it.
std::string refusal(std::string_view text) {
    const test::TemporaryFile file("face.rig.json", text);
    const Result<RigDescription> loaded = load_rig_description(file.path(), small_face());
    if (loaded) return "(loads)";
    const std::string opening = file.path().string() + ": ", &message = loaded.error().message;
    return message.starts_with(opening) ? message.substr(opening.size()) : "(does not name the file) " + message;
}

TEST(RigFile, TakesThePlaceOfWhatItMentionsAndLeavesTheRest) {
    const Face face = small_face();
    const auto loaded = load_rig(
        "\xEF\xBB\xBF"
        R"({
        "blush_rig": 1, "name": "a test",
        "action_units": {"AU12": {"meaning": "one-sided", "drives": {"mouthSmileLeft": 0.5}}},
        "emotions": {"pride": {"drives": {"AU27": 1}}},
        "compounds": {"proudSmile": {"drives": {"pride": 0.5, "AU12": 1}}},
        "states": {"sunburn": {"drives": {}}},
        "in_betweens": [],
        "correctives": [{"target": "fix", "drivers": ["jawOpen", "AU12"], "rule": "minimum", "weight": 0.5}],
        "limits": {"jawOpen": {"high": 0.75, "holds_own": true}},
        "wrinkles": {"weights": {"Pride": [0, 0, 0, 0, 0, 0, 0, 0.5, 0, 0, 0, 0], "joy": [0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]}},
        "hemoglobin": {"maps": ["sunburn"], "weights": {"sunburn": {"maps": {"sunburn": 1}, "factor": 1.5}}}
    })",
        face);
    ASSERT_TRUE(loaded) << loaded.error().message;
    test::PosedRig posed(face, *loaded);
    posed.with({{"AU12", 1}});
    EXPECT_EQ(posed.weight("mouthSmileLeft"), 0.5F);
    EXPECT_EQ(posed.weight("mouthSmileRight"), 0);
    posed.with({{"proudSmile", 1}});
    EXPECT_EQ(posed.weight("jawOpen"), 0.5F) << "no in-betweens here";
    EXPECT_EQ(posed.weight("fix"), 0.25F);
    EXPECT_EQ(posed.zone("chin"), 0.25F);
    EXPECT_EQ(posed.with({{"jawOpen", 1}}).weights[0], 0.75F);
    posed.with({{"joy", 1}});
    EXPECT_EQ(posed.zone("chin"), 1);
    EXPECT_EQ(posed.zone("foreheadOuterLeft"), 0);
    posed.with({{"sunburn", 1}});
    EXPECT_EQ(posed.blood("sunburn"), 1);
    EXPECT_EQ(posed.pose.hemoglobin_factor, 1.5F);
    posed.with({{"anger", 1}});
    EXPECT_FLOAT_EQ(posed.pose.hemoglobin_factor, 1.27F) << "the library's rows stay";
}

TEST(RigFile, NewZonesReplaceTheEight) {
    const auto loaded = load_rig(
        R"({"blush_rig": 1, "wrinkles": {"zones": [{"name": "forehead"}, {"name": "chin", "low": -1, "high": 2}],
            "weights": {"joy": [0.5, 3], "anger+joy": [-0.5, 0]}}})",
        small_face());
    ASSERT_TRUE(loaded) << loaded.error().message;
    test::PosedRig posed(small_face(), *loaded);
    EXPECT_THAT(posed.with({{"joy", 1}}).wrinkles, testing::ElementsAre(0.5F, 2));
    EXPECT_THAT(posed.with({{"joy", 1}, {"anger", 1}}).wrinkles, testing::ElementsAre(0, 2));
    EXPECT_THAT(posed.with({{"anger", 1}}).wrinkles, testing::ElementsAre(0, 0));
}

TEST(RigFile, AnEmptyOneIsTheDefault) {
    const auto loaded = load_rig(R"({"blush_rig": 1})", small_face());
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->in_betweens.size(), 1U);
    EXPECT_EQ(loaded->expressions.size(), default_description(small_face()).expressions.size());
}

TEST(RigFile, EveryFaultHasItsSentence) {
    const auto rig = [](const std::string& inside) { return "{\"blush_rig\": 1, " + inside + "}"; };
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"", "the file is empty"},
        {"[]", "a rig must be an object, not array"},
        {"{}", "not a rig description: the key 'blush_rig' is missing"},
        {R"({"blush_rig": 2})", "blush_rig: version 2 is not known, only 1 is"},
        {"{\"blush_rig\": 1,,}", "line 1, column 17: not valid JSON: unexpected ','; expected string literal"},
        {rig(R"("emotion": {})"), "emotion: there is no such key (did you mean 'emotions'?)"},
        {rig(R"("emotions": [])"), "emotions: it must be an object, not array"},
        {rig(R"("emotions": {"joy": {}})"), "emotions.joy: the key 'drives' is missing"},
        {rig(R"("emotions": {"joy": {"drives": {}, "drivs": 1}})"),
         "emotions.joy.drivs: there is no such key (did you mean 'drives'?)"},
        {rig(R"("emotions": {"joy": {"drives": {"AU6": "much"}}})"),
         "emotions.joy.drives.AU6: it must be a number, not string"},
        {rig(R"("emotions": {"joy": {"drives": {"AU6": 1e300}}})"),
         "emotions.joy.drives.AU6: it must be a number from -100 to 100"},
        {rig(R"("emotions": {"joy": {"drives": {"AU99": 1}}})"),
         "emotions.joy.drives.AU99: there is no control 'AU99' (did you mean 'AU9'?)"},
        {rig(R"("emotions": {"joy": {"drives": {}}, "joy": {"drives": {}}})"),
         "the key 'joy' is there twice in one object"},
        {rig(R"("emotions": {"joy": {"drives": {}}}, "compounds": {"Joy": {"drives": {}}})"),
         "compounds.Joy: it is there twice"},
        {rig(R"("emotions": {"a": {"drives": {"b": 1}}, "b": {"drives": {"a": 1}}})"),
         "drivers: 'a' drives itself ('a' > 'b' > 'a')"},
        {rig(R"("emotions": {"a\u0007": {"drives": 3}})"), "emotions.a?.drives: it must be an object, not number"},
        {rig("\"emotions\": {\"" + std::string(300, 'x') + "\": 0}"), "emotions: a name may have 200 bytes"},
        {rig(R"("in_betweens": [{"shape": "jawOpen", "target": "fix"}])"), "in_betweens[0]: the key 'at' is missing"},
        {rig(R"("in_betweens": [{"shape": "jawOpen", "target": "fix", "at": 2}])"),
         "in_betweens[0].at: it must be between 0 and 1"},
        {rig(R"("correctives": [{"target": "fix", "drivers": ["jawOpen", "fix"]}])"),
         "drivers: 'fix' drives itself ('fix' > 'fix')"},
        {rig(R"("correctives": [{"target": "fix", "drivers": ["jawOpen", 7]}])"),
         "correctives[0].drivers[1]: it must be a string, not number"},
        {rig(R"("correctives": [{"target": "fix", "drivers": ["jawOpen", "AU6"], "rule": "sum"}])"),
         "correctives[0].rule: it is neither product nor minimum"},
        {rig(R"("limits": {"jawOpen": {"holds_own": 1}})"),
         "limits.jawOpen.holds_own: it must be true or false, not number"},
        {rig(R"("limits": {"jawOpen": {}, "JawOpen": {}})"), "limits.JawOpen: it is there twice"},
        {rig(R"("wrinkles": {"weights": {"joy": [1]}})"),
         "wrinkles.weights.joy: it must have one weight for each of the 12 zones, not 1"},
        {rig(R"("wrinkles": {"weights": {"joy+": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1]}})"),
         "wrinkles.weights.joy+: there is no control ''"},
        {rig(R"("wrinkles": {"weights": {"joy+fear": [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1], "Joy+fear": []}})"),
         "wrinkles.weights.Joy+fear: it is there twice"},
        {rig(R"("hemoglobin": {"weights": {"joy": {"maps": {}}, "Joy": {"maps": {}}}})"),
         "hemoglobin.weights.Joy: it is there twice"},
        {rig(R"("hemoglobin": {"maps": ["joy"]})"), "hemoglobin.maps: 'joy' is there twice"},
        {rig(R"("hemoglobin": {"maps": ["neutral"]})"), "hemoglobin.maps: a map may not be named 'neutral'"},
        {rig(R"("hemoglobin": {"weights": {"joy": {"maps": {"rash": 1}}}})"),
         "hemoglobin.weights.joy.maps: there is no map 'rash'"},
    };
    for (const auto& [text, message] : faults) EXPECT_EQ(refusal(text), message) << text;
    const auto missing = load_rig_description("/no/such.rig.json", small_face());
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "/no/such.rig.json: there is no such file");
}

TEST(RigFile, ThousandsOfEntriesTakeNoLongTime) {
    std::string emotions, limits, wrinkles, hemoglobin;
    for (int i = 0; i < 5'000; ++i) {
        const std::string name = "e" + std::to_string(i), comma = i == 0 ? "" : ",";
        emotions += comma + "\"" + name + "\": {\"drives\": {\"AU6\": 1}}";
        limits += comma + "\"" + name + "\": {}";
        wrinkles += comma + "\"" + name + "\": [0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]";
        hemoglobin += comma + "\"" + name + "\": {\"maps\": {\"joy\": 1}}";
    }
    EXPECT_EQ(refusal(R"({"blush_rig": 1, "emotions": {)" + emotions + R"(}, "limits": {)" + limits +
                      R"(}, "wrinkles": {"weights": {)" + wrinkles + R"(}}, "hemoglobin": {"weights": {)" + hemoglobin +
                      "}}}"),
              "(loads)");
}

TEST(RigFile, EveryTruncationHasASentence) {
    const std::string whole =
        R"({"blush_rig": 1, "limits": {"jawOpen": {"high": 1}}, "emotions": {"a": {"drives": {"AU6": 1}}}})";
    ASSERT_EQ(refusal(whole), "(loads)");
    for (std::size_t length = 1; length < whole.size(); ++length) {
        EXPECT_THAT(refusal(whole.substr(0, length)), testing::StartsWith("line 1, column ")) << length;
    }
}

TEST(RigFile, IsFoundBesideItsFace) {
    Face face = small_face();
    const test::TemporaryFile rig("beside.rig.json", R"({"blush_rig": 1, "limits": {"jawOpen": {"high": 0.5}}})");
    const std::string stem = rig.path().string().substr(0, rig.path().string().size() - 9);
    face.path = stem + ".glb";
    EXPECT_EQ(rig_description_beside(face.path), rig.path());
    const auto found = find_rig_description(face);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->path, rig.path().string());
    EXPECT_EQ(found->limits.back().high, 0.5F);
    face.path = "/nowhere/face.glb";
    EXPECT_EQ(rig_description_beside(face.path), std::nullopt);
    const auto none = find_rig_description(face);
    ASSERT_TRUE(none);
    EXPECT_EQ(none->path, "");
}

}  // namespace
}  // namespace blush
