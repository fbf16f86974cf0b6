/// What each command gives on a good face: the right numbers, the same bytes twice, a progress that suits a pipe.

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/shared_data.h"
#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

using Vertex = std::array<float, 6>;  // position, normal

std::vector<Vertex> vertices_of_ply(const std::string& text) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line) && line != "end_header";) {
        if (line.starts_with("element vertex ")) count = std::stoul(line.substr(15));
    }
    std::vector<Vertex> vertices(count);
    for (Vertex& vertex : vertices) {
        for (float& number : vertex) lines >> number;
    }
    EXPECT_TRUE(lines) << "the file ends before its last vertex";
    return vertices;
}

float largest_difference(const std::vector<Vertex>& one, const std::vector<Vertex>& other, std::size_t numbers) {
    EXPECT_EQ(one.size(), other.size());
    float largest = 0;
    for (std::size_t v = 0; v < std::min(one.size(), other.size()); ++v) {
        for (std::size_t c = 0; c < numbers; ++c) largest = std::max(largest, std::abs(one[v][c] - other[v][c]));
    }
    return largest;
}

TEST_F(Cli, InfoListsWhatIsThere) {
    const Ran text = blush("info face.glb");
    EXPECT_EQ(text.exit_status, 0);
    EXPECT_THAT(text.output, HasSubstr("face.glb: 81 vertices, 128 triangles, 1 nodes, 0 skins\n"));
    EXPECT_THAT(text.output, HasSubstr("targets (3)"));
    const Json json = Json::parse(blush("info face.glb --json").output);
    EXPECT_EQ(json["vertices"], 81);
    EXPECT_EQ(json["targets"][0]["name"], "jawOpen");
    EXPECT_EQ(json["targets"][0]["vertices_moved"], 2);
    EXPECT_FLOAT_EQ(json["targets"][0]["largest_move"].get<float>(), std::sqrt(1.0625F));
    EXPECT_EQ(json["targets"][2]["own_normals"], true);
    EXPECT_FLOAT_EQ(json["animations"][0]["duration_seconds"].get<float>(), 0.2F);
    EXPECT_TRUE(json["not_understood"].empty());
}

TEST_F(Cli, EvaluateAddsTheWeightedDeltas) {
    expect_works("evaluate face.glb -o rest.ply --check-finite");
    expect_works("evaluate face.glb --set jawOpen=0.5,mouthSmile_L=1 -o posed.ply --check-finite");
    const std::vector<Vertex> rest = vertices_of_ply(bytes_of("rest.ply")),
                              posed = vertices_of_ply(bytes_of("posed.ply"));
    ASSERT_EQ(rest.size(), 81U);
    ASSERT_EQ(posed.size(), 81U);
    for (std::size_t v = 0; v < rest.size(); ++v) {
        Vertex wanted = rest[v];
        if (v == 3) wanted = {rest[v][0], rest[v][1] - 0.5F, 0.125F, 0, 0.25F, 1};
        if (v == 4) wanted = {rest[v][0] + 0.25F, rest[v][1] - 0.25F, 0.5F, 0.5F, 0.125F, 1};
        if (v == 40) wanted = {rest[v][0], rest[v][1], 0.25F, 0, 0.5F, 1};
        const float length = std::hypot(wanted[3], wanted[4], wanted[5]);
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(posed[v][c], wanted[c]) << "vertex " << v;  // the numbers are exact in binary
            EXPECT_NEAR(posed[v][c + 3], wanted[c + 3] / length, 1e-6F) << "vertex " << v;
        }
    }
}

TEST_F(Cli, EvaluateGivesTheSameOnBothPaths) {
    // A target without normals of its own: they are recomputed.
    GlbBuilder().grid(8, 8).target("jawOpen", {40, 41}, {{0, 0, 0.5F}, {0, 0.25F, 0.5F}}).write(path("recomputed.glb"));
    for (const char* posed : {"face.glb --set jawOpen=0", "face.glb --set jawOpen=0.3,mouthSmileLeft=0.7",
                              "face.glb --set jawOpen=-2,eyeBlinkLeft=1", "recomputed.glb --set jawOpen=0.6"}) {
        expect_works(std::string("evaluate --on cpu -o cpu.ply ") + posed);
        expect_works(std::string("evaluate --on gpu -o gpu.ply ") + posed);
        const auto cpu = vertices_of_ply(bytes_of("cpu.ply")), gpu = vertices_of_ply(bytes_of("gpu.ply"));
        EXPECT_EQ(largest_difference(cpu, gpu, 6), 0) << posed;
    }
}

TEST_F(Cli, EvaluateWritesObj) {
    expect_works("evaluate face.glb -o out.obj");
    const std::string text = bytes_of("out.obj");
    EXPECT_TRUE(text.starts_with("v -1 -1 0\n"));
    EXPECT_THAT(text, HasSubstr("vn 0 0 1\n"));
    EXPECT_THAT(text, HasSubstr("f 1//1 2//2 11//11\n"));
    const Json json = Json::parse(blush("info out.obj --json").output);
    EXPECT_EQ(json["triangles"], 128) << "what evaluate writes can be read";
}

TEST_F(Cli, TheCompressedHeadIsThePlainOne) {
    BLUSH_SHARED_OR_SKIP(folder, "faces/facecap");
    for (const char* pose : {"jawOpen=0", "jawOpen=0.6,mouthSmileLeft=1"}) {
        for (const char* name : {"facecap", "facecap_plain"}) {
            expect_works("evaluate '" + (folder / (std::string(name) + ".glb")).string() + "' --space world --set " +
                         pose + " -o " + name + ".ply");
        }
        const auto compressed = vertices_of_ply(bytes_of("facecap.ply")),
                   plain = vertices_of_ply(bytes_of("facecap_plain.ply"));
        EXPECT_EQ(plain.size(), 4368U);
        EXPECT_LT(largest_difference(compressed, plain, 3), 0.001F) << pose;
    }
}

TEST_F(Cli, TheSameArgumentsGiveTheSameBytes) {
    const std::string pose = " --set jawOpen=0.4 --size 64x64 --check-finite -o ";
    for (const char* ending : {"png", "exr"}) {
        expect_works(std::string("render face.glb") + pose + "1." + ending);
        expect_works(std::string("render face.glb") + pose + "2." + ending);
        expect_same(std::string("1.") + ending, std::string("2.") + ending);
    }
    expect_works("render face.glb --size 64x64 -o rest.png");
    EXPECT_NE(bytes_of("rest.png"), bytes_of("1.png")) << "an open jaw shows";
    EXPECT_EQ(blush("explain face.glb --json").output, blush("explain face.glb --json").output);
}

TEST_F(Cli, WhatIsLeftOutExactlyChangesNoByte) {
    for (const char* pose : {"jawOpen=0", "jawOpen=0.7", "mouthSmileLeft=1,eyeBlinkLeft=0.5"}) {
        const std::string set = std::string("render face.glb --size 64x64 --set ") + pose;
        expect_works(set + " -o as_needed.png");
        expect_works(set + " --force-effects -o forced.png");
        expect_same("as_needed.png", "forced.png");
    }
}

TEST_F(Cli, PlayWritesNumberedPicturesAndTellsAPipePlainly) {
    const Ran ran =
        blush("play face.glb --fps 20 --size 64x64 --check-finite -o frames/%03d.png --contact-sheet sheet.png");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    const std::set<std::string> wanted = {"face.glb",       "frames",         "frames/000.png", "frames/001.png",
                                          "frames/002.png", "frames/003.png", "frames/004.png", "sheet.png"};
    EXPECT_EQ(listing(path("")), wanted);
    EXPECT_EQ(ran.errors, "frames: 1 of 5\nframes: 2 of 5\nframes: 3 of 5\nframes: 4 of 5\nframes: 5 of 5\n");
    EXPECT_NE(bytes_of("frames/000.png"), bytes_of("frames/004.png")) << "the face moves";
}

TEST_F(Cli, PlayWritesTheSameVideoTwice) {
    if (run("command -v ffmpeg").exit_status != 0) GTEST_SKIP() << "no ffmpeg here";
    for (const char* ending : {"mp4", "gif"}) {
        for (const char* name : {"1.", "2."}) {
            expect_works(std::string("play face.glb --to 0.1 --size 65x63 -o ") + name + ending);
        }
        expect_same(std::string("1.") + ending, std::string("2.") + ending);
    }
}

TEST_F(Cli, PlayWithoutFfmpegWritesPicturesAndSaysSo) {
    const Ran ran = blush("play face.glb --to 0.04 --size 64x64 -o out.mp4", "PATH=/nowhere ");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("note: there is no ffmpeg program here (Debian: ffmpeg), so the frames go to "
                                      "out/%05d.png instead of out.mp4\n"));
    EXPECT_EQ(listing(path("")), (std::set<std::string>{"face.glb", "out", "out/00000.png", "out/00001.png"}));
}

TEST_F(Cli, PlayNamesOnceWhatDoesNotMatch) {
    write(
        "p.json",
        R"({"blush_performance": 1, "channels": {"JawOpen": {"keys": [[0, 0], [0.1, 1]]}, "earWiggle": {"keys": [[0, 0]]}}})");
    const Ran ran = blush("play face.glb --performance p.json --size 64x64 --fps 10 -o %d.png");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("channels without a control on face.glb: earWiggle\n"));
    EXPECT_THAT(ran.errors, HasSubstr("targets of face.glb without a channel: mouthSmileLeft, eyeBlinkLeft\n"));
}

TEST_F(Cli, ExplainNamesEveryEffectWithAReason) {
    const Json json = Json::parse(blush("explain face.glb --set jawOpen=0.5 --json").output);
    std::set<std::string> names;
    for (const Json& effect : json["effects"]) {
        names.insert(effect["name"]);
        EXPECT_FALSE(effect["reason"].get<std::string>().empty()) << effect["name"];
        EXPECT_NE(effect["on"].get<bool>(), effect.contains("omission")) << effect["name"];
    }
    EXPECT_THAT(names, ::testing::IsSupersetOf({"deformation", "normals"}));
    ASSERT_EQ(json["active_targets"].size(), 1U);
    EXPECT_EQ(json["active_targets"][0]["name"], "jawOpen");
    EXPECT_EQ(json["deltas_added"], 2);
    EXPECT_THAT(blush("explain face.glb --set jawOpen=0.5").output, HasSubstr("  jawOpen = 0.5\n"));
    EXPECT_GT(json["scale"]["millimetres_a_unit"], 0);
    EXPECT_THAT(blush("explain face.glb --setting scattering.millimetres_a_unit=52").output,
                HasSubstr("scale: 52 mm a unit, since scattering.millimetres_a_unit says so\n"));
}

TEST_F(Cli, AccuracyWritesAPageAndNumbers) {
    expect_works("accuracy face.glb --quick --effect normals -o report");
    const Json json = Json::parse(bytes_of("report/accuracy.json"));
    ASSERT_FALSE(json["studies"].empty());
    for (const Json& study : json["studies"]) EXPECT_EQ(study["effect"], "normals");
    EXPECT_THAT(bytes_of("report/index.html"), HasSubstr("<h2>normals</h2>"));
}

TEST_F(Cli, BakeFaceWritesAPersonThatLoads) {
    const Ran ran = blush("bake face --preset mei --set jaw_width=+1 --vertices 5000 --texture-size 128 -o made.glb");
    ASSERT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_EQ(listing(path("")), (std::set<std::string>{"face.glb", "made.glb"}));
    const Json json = Json::parse(blush("info made.glb --json").output);
    EXPECT_EQ(json["targets"].size(), 52U);
    EXPECT_TRUE(json["not_understood"].empty());
}

}  // namespace
}  // namespace blush::test
