/// blush explain: the plan of the very frame that render draws with the same options.

#include <nlohmann/json.hpp>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// What `render` says it ran, and what `explain` says of the same words. Both at once: each takes a core.
struct Plans {
    std::string rendered, explained;
};

class CliExplain : public Cli {
protected:
    Plans plans(const std::string& words) const {
        std::filesystem::remove(path("rendered.json"));
        const Ran both = run("'" BLUSH_PROGRAM "' render " + words +
                                 " -o x.png --report rendered.json >/dev/null & '" BLUSH_PROGRAM "' explain " + words +
                                 " --json; wait",
                             path(""));
        EXPECT_EQ(both.errors, "") << words;
        return {bytes_of("rendered.json"), both.output};
    }
    void expect_same_plans(const std::string& face, const std::vector<std::string>& all_words) const {
        for (const std::string& words : all_words) {
            const auto [rendered, explained] = plans(face + " " + words);
            EXPECT_FALSE(rendered.empty()) << words;
            EXPECT_EQ(rendered, explained) << words;
        }
    }
    void make_head() const {
        const Ran made = run("'" MAKE_FACE_PROGRAM "' -o head.glb --vertices 5000 --texture-size 64", path(""));
        ASSERT_EQ(made.exit_status, 0) << made.errors;
    }
    /// Of `words`: the effect's entry.
    Json effect(const std::string& words, const std::string& name) const {
        const Json plan = Json::parse(blush("explain " + words + " --json").output);
        for (const Json& entry : plan["effects"]) {
            if (entry["name"] == name) return entry;
        }
        return {};
    }
};

TEST_F(CliExplain, PlansWhatRenderDraws) {
    expect_works("render face.glb --size 32x16 -o sky.hdr");
    write("lamp.json", R"({"lights": [{"kind": "directional", "from": [0.3, 0.4, 1], "radiance": [1, 1, 1]}]})");
    expect_same_plans("face.glb", {
                                      "",
                                      "--size 1x1",
                                      "--size 64x32",
                                      "--size 32x64 --yaw 80",
                                      "--size 32x32 --pitch -60 --zoom 4",
                                      "--size 32x32 --zoom 0.02",
                                      "--size 32x32 --exposure 100",
                                      "--size 32x32 --set jawOpen=0.7",
                                      "--size 32x32 --set jawOpen=0.7,mouthSmileLeft=1,eyeBlinkLeft=0.5",
                                      "--size 32x32 --emotion joy=1",
                                      "--size 32x32 --state blush=1",
                                      "--size 32x32 --defaults",
                                      "--size 32x32 --force-effects",
                                      "--size 32x32 --set jawOpen=1 --force-effects",
                                      "--size 32x32 --check-finite",
                                      "--size 32x32 --lights front",
                                      "--size 32x32 --lights side",
                                      "--size 32x32 --lights behind",
                                      "--size 32x32 --lights orbit --at 7",
                                      "--size 32x32 --lights lamp.json",
                                      "--size 32x32 --environment sky.hdr",
                                      "--size 32x32 --environment sky.hdr --environment-factor 0",
                                      "--size 32x32 --environment sky.hdr --environment-turn 90 --lights behind",
                                      "--size 32x32 --script a_minute --at 0",
                                      "--size 32x32 --script a_minute --at 5.5 --seed 3",
                                      "--size 32x32 --script a_minute --at 2 --life off",
                                      "--size 32x32 --life talking --at 1",
                                      "--size 32x32 --state blush=1 --blood slow --at 3",
                                      "--size 32x32 --setting antialiasing.mode=none",
                                      "--size 32x32 --setting antialiasing.mode=msaa2",
                                      "--size 32x32 --setting antialiasing.mode=mlaa",
                                      "--size 32x32 --setting antialiasing.mode=smaa_1x",
                                      "--size 32x32 --setting antialiasing.mode=smaa_s2x --set jawOpen=1",
                                      "--size 32x32 --setting antialiasing.mode=smaa_t2x --set jawOpen=1",
                                      "--size 32x32 --setting antialiasing.mode=smaa_4x --set jawOpen=1",
                                      "--size 32x32 --setting antialiasing.mode=supersampled",
                                      "--size 32x32 --setting bloom.strength=0.1",
                                      "--size 32x32 --setting depth_of_field.f_number=1.4",
                                      "--size 32x32 --setting exposure.mode=automatic --lights behind",
                                      "--size 32x32 --setting grain.strength=0.05 --at 1",
                                      "--size 32x32 --setting deformation.method=passes --set jawOpen=1",
                                      "--size 32x32 --setting normals.source=recomputed --set jawOpen=1",
                                  });
}

TEST_F(CliExplain, PlansWhatRenderDrawsOfAHead) {
    make_head();
    expect_same_plans("head.glb", {
                                      "--size 64x64",
                                      "--size 16x16",
                                      "--size 48x48 --zoom 0.05",
                                      "--size 48x48 --lights behind --setting translucency.strength=0",
                                      "--size 48x48 --setting scattering.strength_red=0 --lights side",
                                      "--size 48x48 --emotion anger=1 --setting antialiasing.mode=smaa_t2x",
                                      "--size 48x48 --setting reflection.intensity=0 --exposure 0.5",
                                      "--size 48x48 --script a_minute --at 4 --lights orbit",
                                      "--size 48x48 --setting depth_of_field.f_number=2 --zoom 3 --yaw 20",
                                  });
}

TEST_F(CliExplain, AFaceFarAwayLeavesScatteringOutWithinABound) {
    make_head();
    EXPECT_EQ(effect("head.glb --size 256x256", "scattering")["on"], true);
    const std::string far = "head.glb --size 32x32 --zoom 0.05";
    const Json scattering = effect(far, "scattering");
    EXPECT_EQ(scattering["on"], false);
    EXPECT_EQ(scattering["omission"], "bounded");
    EXPECT_THAT(blush("explain " + far).output,
                HasSubstr("(bounded: by at most 0.1 of the brightest neighbour's radiance)\n"));
}

/// Of a mode that takes two frames for one picture, what either of them ran was run.
TEST_F(CliExplain, TheFirstOfTwoFramesCounts) {
    const std::string words = "face.glb --size 32x32 --set jawOpen=1 --setting antialiasing.mode=";
    EXPECT_EQ(effect(words + "smaa_1x", "deformation")["on"], true);
    EXPECT_EQ(effect(words + "smaa_t2x", "deformation")["on"], true);
    EXPECT_EQ(effect(words + "smaa_t2x", "reprojection")["on"], true);
}

/// A file that holds radiance has no filmic curve.
TEST_F(CliExplain, ThePictureThatIsMeantCounts) {
    EXPECT_THAT(blush("explain face.glb --size 32x32").output, HasSubstr("\n  tone\n"));
    EXPECT_THAT(blush("explain face.glb --size 32x32 -o x.exr").output, Not(HasSubstr("\n  tone\n")));
    EXPECT_EQ(listing(path("")), std::set<std::string>{"face.glb"});
}

TEST_F(CliExplain, APictureAndItsReportAreBothWrittenOrNeither) {
    expect_refused("render face.glb --size 8x8 -o no/x.png --report r.json",
                   "no/x.png: cannot be written: the folder no does not exist");
    expect_refused("render face.glb --size 8x8 -o x.png --report no/r.json",
                   "no/r.json: cannot be written: the folder no does not exist");
}

}  // namespace
}  // namespace blush::test
