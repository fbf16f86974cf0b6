// Controls, emotions, states and rig descriptions at the command line.

#include <nlohmann/json.hpp>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

TEST_F(Cli, ControlsListsThemByKindWithWhatTheyDrive) {
    const Ran ran = blush("controls face.glb");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("targets (3), 0 to 1\n  jawOpen\n"));
    EXPECT_THAT(ran.output, HasSubstr("angles (9), -1 to 1 radians\n"));
    EXPECT_THAT(ran.output,
                HasSubstr("  AU12: lip corner puller; drives mouthSmileLeft 1; wrinkles crowsFeetLeft 0.15, "
                          "nasolabialLeft 0.9; blood joy 0.25\n"));
    EXPECT_THAT(ran.output, HasSubstr("  AU12: mouthSmileRight\n"));
    EXPECT_THAT(ran.output, HasSubstr("ARKit shapes without a match (49)\n"));
    const Json json = Json::parse(blush("controls face.glb --json").output);
    EXPECT_EQ(json["controls"][0]["name"], "jawOpen");
    EXPECT_EQ(json["controls"][0]["kind"], "target");
    EXPECT_EQ(json["wrinkle_zones"].size(), 12U);
    EXPECT_EQ(json["hemoglobin_maps"].size(), 11U);
    EXPECT_TRUE(json["rig"].is_null());
}

TEST_F(Cli, EmotionsAndStatesPoseTheFace) {
    expect_works("evaluate face.glb --set AU27=1 -o unit.ply");
    expect_works("evaluate face.glb --set jawOpen=1 -o target.ply");
    expect_same("unit.ply", "target.ply");
    expect_works("evaluate face.glb --emotion joy=0 --state blush=0 -o zero.ply");
    expect_works("evaluate face.glb -o rest.ply");
    expect_same("zero.ply", "rest.ply");
    expect_works("evaluate face.glb --emotion joy=0.7,anger=0.2,shySmile=0.1 -o cpu.ply");
    expect_works("evaluate face.glb --emotion joy=0.7,anger=0.2,shySmile=0.1 --on gpu -o gpu.ply");
    expect_same("cpu.ply", "gpu.ply");
    EXPECT_NE(bytes_of("cpu.ply"), bytes_of("rest.ply"));
    expect_works("render face.glb --emotion joy=1 --state blush=1 --size 64x64 --check-finite -o joy.png");
    expect_works("play face.glb --emotion joy=1 --to 0.05 --fps 20 --size 64x64 -o joy%d.png");
}

TEST_F(Cli, EmotionsAndStatesAreToldApart) {
    expect_refused("evaluate face.glb -o x.ply --emotion jyo=1",
                   "--emotion jyo=1: face.glb has no emotion \"jyo\" (did you mean \"joy\"?)");
    expect_refused("evaluate face.glb -o x.ply --emotion blush=1",
                   "--emotion blush=1: face.glb has no emotion \"blush\"");
    expect_refused("evaluate face.glb -o x.ply --emotion jawOpen=1",
                   "--emotion jawOpen=1: face.glb has no emotion \"jawOpen\"");
    expect_refused("evaluate face.glb -o x.ply --state joy=1", "--state joy=1: face.glb has no state \"joy\"");
    expect_refused("evaluate face.glb -o x.ply --state blush=much",
                   "--state blush=much: \"much\" is not a finite number");
}

TEST_F(Cli, ARigBesideTheFaceOrNamedIsTaken) {
    const std::string half = R"({"blush_rig": 1, "emotions": {"joy": {"drives": {"jawOpen": 0.5}}}})";
    write("half.json", half);
    expect_works("evaluate face.glb --rig half.json --emotion joy=1 -o named.ply");
    expect_works("evaluate face.glb --set jawOpen=0.5 -o jaw.ply");
    expect_same("named.ply", "jaw.ply");
    write("face.rig.json", half);
    expect_works("evaluate face.glb --emotion joy=1 -o beside.ply");
    expect_works("evaluate face.glb --on gpu --emotion joy=1 -o beside_gpu.ply");
    expect_same("beside.ply", "jaw.ply");
    expect_same("beside_gpu.ply", "jaw.ply");
    EXPECT_THAT(blush("controls face.glb").output, HasSubstr(" controls, rig face.rig.json\n"));
    write("face.rig.json", R"({"blush_rig": 1, "emotions": {"joy": {"drives": {"jawOpne": 0.5}}}})");
    const std::string sentence =
        "face.rig.json: emotions.joy.drives.jawOpne: there is no control 'jawOpne' (did you mean 'jawOpen'?)";
    expect_refused("render face.glb -o x.png", sentence);
    expect_refused("evaluate face.glb -o x.ply", sentence);
    expect_refused("controls face.glb", sentence);
    expect_refused("lint face.rig.json", sentence);
    EXPECT_THAT(blush("lint face.glb").output, HasSubstr("face.glb: rig: " + sentence + "\n"));
}

TEST_F(Cli, LintNamesWhatIsOddAndChangesNothing) {
    const std::string before = bytes_of("face.glb");
    const Ran ran = blush("lint face.glb");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("face.glb: targets.mouthSmileLeft: it has no twin on the right\n"));
    EXPECT_THAT(ran.output, HasSubstr("face.glb: targets: ARKit's jawForward has no match\n"));
    EXPECT_THAT(ran.output, HasSubstr("face.glb: nodes: none is a left eye: its angles turn nothing\n"));
    GlbBuilder()
        .grid(8, 8)
        .target("jawOpne", {3}, {{0, 0, 1}})
        .target("same", {3}, {{0, 0, 1}})
        .target("still", {3}, {{0, 0, 0}})
        .target("far", {3}, {{0, 0, 1000}})
        .write(path("odd.glb"));
    const std::string odd = blush("lint odd.glb").output;
    EXPECT_THAT(odd, HasSubstr("targets.still: it moves nothing\n"));
    EXPECT_THAT(odd, HasSubstr("targets.same: it is the same shape as 'jawOpne'\n"));
    EXPECT_THAT(odd, HasSubstr("targets.far: it moves a vertex by more than half the face\n"));
    EXPECT_THAT(odd, HasSubstr("targets: none of ARKit's names has a match"));
    write("face.rig.json", R"({"blush_rig": 1, "emotions": {"pride": {"drives": {"tongueOut": 1, "AU6": 0, "AU12": 2}}},
        "limits": {"jawOpen": {"high": 0}}, "hemoglobin": {"maps": ["rash"]},
        "correctives": [{"target": "jawOpen", "drivers": ["AU6", "tongueOut"]}]})");
    const Json json = Json::parse(blush("lint face.rig.json --json").output);
    std::set<std::string> found;
    for (const Json& finding : json["findings"]) {
        found.insert(finding["place"].get<std::string>() + ": " + finding["finding"].get<std::string>());
    }
    EXPECT_THAT(found, ::testing::IsSupersetOf(
                           {"emotions.pride.drives.tongueOut: this face has no such shape",
                            "emotions.pride.drives.AU6: its weight is 0",
                            "emotions.pride.drives.AU12: its weight is above 1: it gets to the end of its range early",
                            "limits.jawOpen: nothing can move it", "hemoglobin.maps: nothing has a share of 'rash'",
                            "correctives[0].target: expressions drive 'jawOpen' too",
                            "correctives[0]: this face has no 'tongueOut': it never acts"}));
    write("alone.rig.json", R"({"blush_rig": 1})");
    expect_refused("lint alone.rig.json", "alone.rig.json: no face stands beside it; name one by --face");
    EXPECT_EQ(blush("lint alone.rig.json --face face.glb").exit_status, 0);
    EXPECT_EQ(blush("lint face.xyz").exit_status, 2);
    expect_refused("lint none.glb", "none.glb: there is no such file");
    EXPECT_EQ(bytes_of("face.glb"), before);
}

TEST_F(Cli, ExplainSaysWhatTheRigLeavesOut) {
    write("face.rig.json",
          R"({"blush_rig": 1, "correctives": [{"target": "eyeBlinkLeft", "drivers": ["jawOpen", "AU12"]}]})");
    const Json json = Json::parse(blush("explain face.glb --emotion anger=1 --state blush=0.5 --json").output)["rig"];
    EXPECT_EQ(json["correctives"][0]["target"], "eyeBlinkLeft");
    EXPECT_EQ(json["correctives"][0]["without"], Json({"jawOpen", "AU12"}));
    EXPECT_EQ(json["at_rest"]["state"], 4);
    EXPECT_EQ(json["at_rest"]["emotion"], 5);
    EXPECT_NEAR(json["hemoglobin"]["anger"].get<float>(), 2.0F / 3, 1e-6F);
    EXPECT_EQ(json["wrinkles"]["glabella"], 1.0);
    const std::string text = blush("explain face.glb --emotion anger=1").output;
    EXPECT_THAT(text, HasSubstr("  corrective eyeBlinkLeft: left out, since jawOpen is at rest (exact)\n"));
    EXPECT_THAT(text, HasSubstr("5 emotions"));
    EXPECT_THAT(text, HasSubstr("  anger = 1 (emotion)\n"));
    EXPECT_THAT(text, HasSubstr("  all hemoglobin times 1.27\n"));
    EXPECT_THAT(blush("explain face.glb --set jawOpen=1,AU12=0.5").output,
                HasSubstr("  corrective eyeBlinkLeft = 0.5\n"));
}

}  // namespace
}  // namespace blush::test
