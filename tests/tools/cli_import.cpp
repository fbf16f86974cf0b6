/// blush import, as a user meets it. What the importers do stands in tests/load/import_test.cpp.

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl M_Face\nf 1 2 3\n";

TEST_F(Cli, AnImportedHeadIsAFaceLikeAnyOther) {
    std::filesystem::create_directory(path("ict"));
    write("ict/generic_neutral_mesh.obj", triangle);
    write("ict/jawOpen.obj", std::string(triangle).replace(10, 1, "2"));
    const Ran ran = blush("import ict ict -o head.glb");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_EQ(ran.output, "head.glb: 3 vertices, 1 triangles, 1 targets\n");
    expect_works("info head.glb");
    expect_works("evaluate head.glb --set jawOpen=1 -o open.ply");
}

TEST_F(Cli, BadImportsLeaveNothingBehind) {
    std::filesystem::create_directory(path("ict"));
    write("ict/jawOpen.obj", triangle);
    expect_refused("import ict nothing -o head.glb", "nothing: there is no such file or folder");
    expect_refused("import ict ict -o head.glb",
                   "ict: there is no generic_neutral_mesh.obj in it, the neutral head of ICT-FaceKit");
    expect_refused("import makehuman ict -o head.glb", "ict: there is no base.obj in it, MakeHuman's base mesh");
    write("ict/generic_neutral_mesh.obj", triangle);
    expect_refused("import ict ict -o no/head.glb", "no/head.glb: cannot be written: the folder no does not exist");
    expect_refused("import ict ict", "--output is required");
    expect_refused("import", "A subcommand is required");
}

}  // namespace
}  // namespace blush::test
