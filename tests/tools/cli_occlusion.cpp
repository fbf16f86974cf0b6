/// blush bake occlusion, and what becomes of its file.

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

TEST_F(Cli, OcclusionIsBakedBesideAFaceAndFound) {
    expect_works("render face.glb --size 32x32 -o open.png");
    expect_works("bake occlusion face.glb -o face.occlusion --rays 64");
    expect_works("bake occlusion face.glb -o again.occlusion --rays 64");
    expect_same("face.occlusion", "again.occlusion");
    const Ran explained = blush("explain face.glb");
    EXPECT_NE(explained.output.find("the face hides some of it from itself"), std::string::npos) << explained.output;
    expect_works("render face.glb --size 32x32 -o hidden.png");
    write("face.occlusion", "BLUSHOCC");
    expect_refused("render face.glb -o x.png", "face.occlusion: the file ends too early");
    std::filesystem::remove(path("face.occlusion"));
    expect_refused("bake occlusion face.glb -o x.occlusion --pose noSuchTarget",
                   "face.glb: it has no target \"noSuchTarget\"");
    expect_refused("bake occlusion nothing.glb -o x.occlusion", "nothing.glb: there is no such file");
    expect_refused("bake occlusion face.glb -o none/x.occlusion",
                   "none/x.occlusion: cannot be written: the folder none does not exist");
}

}  // namespace
}  // namespace blush::test
