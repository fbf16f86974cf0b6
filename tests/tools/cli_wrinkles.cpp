/// blush bake wrinkles, and what becomes of its maps.

#include <fstream>
#include <iterator>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

TEST_F(Cli, WrinklesAreBakedBesideAFaceAndFound) {
    std::filesystem::copy_file(std::filesystem::path(BLUSH_PROGRAM).parent_path() / "../assets/face.glb",
                               path("head.glb"));
    expect_works("bake wrinkles head.glb -o head.appearance --size 64 --mask-size 16 --displacement");
    EXPECT_EQ(listing(path("head.appearance")),
              (std::set<std::string>{"displacement_mm.exr", "wrinkle_mask_1.png", "wrinkle_mask_2.png",
                                     "wrinkle_mask_3.png", "wrinkles.json", "wrinkles.png"}));
    expect_works("bake wrinkles head.glb -o again --size 64 --mask-size 16");
    expect_same("head.appearance/wrinkles.png", "again/wrinkles.png");
    expect_same("head.appearance/wrinkle_mask_1.png", "again/wrinkle_mask_1.png");
    // Maps of the part of the layout that folds, or of all of it.
    const auto holds_part = [&](const char* folder) {
        std::ifstream file(path(std::string(folder) + "/wrinkles.json"));
        return std::string(std::istreambuf_iterator<char>(file), {}).find("layout_from") != std::string::npos;
    };
    EXPECT_TRUE(holds_part("again"));
    expect_works("bake wrinkles head.glb -o whole --size 64 --mask-size 16 --layout whole");
    EXPECT_FALSE(holds_part("whole"));
    const Ran explained = blush("explain head.glb --emotion surprise=1");
    EXPECT_NE(explained.output.find("wrinkles"), std::string::npos);
    EXPECT_EQ(explained.output.find("has no wrinkle maps"), std::string::npos) << explained.output;
    std::ofstream(path("head.appearance/wrinkles.json")) << "{}";
    expect_refused("render head.glb -o x.png", "head.appearance: wrinkles.json: zones: not an array of 1 to 12 names");
}

TEST_F(Cli, FacesThatCannotWrinkleAreRefused) {
    write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_refused("bake wrinkles plain.obj -o maps",
                   "plain.obj: no targets like eyeBlinkLeft and mouthSmileLeft move one part of it, so that its skin "
                   "cannot be told from the rest");
    expect_refused("bake wrinkles nothing.glb -o maps", "nothing.glb: there is no such file");
}

}  // namespace
}  // namespace blush::test
