/// The viewer as a user starts it: the program itself, on a display of its own.

#include <gtest/gtest.h>

#include <string>

#include "tests/tools/run_program.h"

namespace {

using blush::test::Ran;
using blush::test::run;

const std::string program = "'" BLUSH_PROGRAM "' ";
// xvfb-run wants xauth, which Debian's xvfb only recommends.
bool have_virtual_display() { return run("command -v xvfb-run && command -v xauth").exit_status == 0; }
/// Runs `blush ARGUMENTS` on a display of its own. xvfb-run ends with statuses of its own when it cannot clean up (5,
/// seen on a busy machine), so the program says its status itself, last on standard output.
Ran run_on_virtual_display(const std::string& arguments, const std::string& variables = "") {
    Ran ran = run(variables + "xvfb-run -a -s '-screen 0 1280x1024x24' sh -c \"" + program + arguments +
                  "; echo ended \\$?\"");
    const std::size_t at = ran.output.rfind("ended ");
    if (at == std::string::npos) return ran;
    ran.exit_status = std::stoi(ran.output.substr(at + 6));
    ran.output.erase(at);
    return ran;
}
const std::string no_display = "env -u DISPLAY -u WAYLAND_DISPLAY ";

TEST(Viewer, DrawsFiveFramesThatAreFinite) {
    if (!have_virtual_display()) GTEST_SKIP() << "no xvfb-run and xauth here (Debian: xvfb, xauth)";
    const Ran ran = run_on_virtual_display("play default --viewer-frames 5 --check-finite --size 256x256");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    // The panel stands beside the picture: 320 units wide on a display of usual density.
    EXPECT_NE(ran.output.find("5 frames of 576x256\n"), std::string::npos) << ran.output;
    EXPECT_EQ(ran.errors.find("blush:"), std::string::npos) << ran.errors;
}

TEST(Viewer, SaysThatTheDisplayHasNoSuchOpenGl) {
    if (!have_virtual_display()) GTEST_SKIP() << "no xvfb-run and xauth here (Debian: xvfb, xauth)";
    // A variable of Mesa; other drivers do not know it.
    const Ran ran = run_on_virtual_display("play default --viewer-frames 1", "MESA_GL_VERSION_OVERRIDE=3.3 ");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.errors.find("blush: this display offers no OpenGL 4.5 core context: "), 0U) << ran.errors;
}

TEST(Viewer, SaysThatThereIsNoDisplay) {
    const Ran ran = run(no_display + program + "play default");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(
        ran.errors,
        "blush: there is no display for a window (DISPLAY and WAYLAND_DISPLAY are not set); -o plays into files\n");
}

TEST(Viewer, SaysThatADisplayCannotBeOpened) {
    const Ran ran = run(no_display + "DISPLAY=:nobody " + program + "play default");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.errors.find("blush: no window can be opened here: "), 0U) << ran.errors;
    EXPECT_EQ(ran.errors.find('\n'), ran.errors.size() - 1) << "one sentence: " << ran.errors;
}

TEST(Viewer, NamesABadRangeBeforeItOpensAWindow) {
    // A display that cannot be opened shows that none was asked for.
    const Ran ran = run(no_display + "DISPLAY=:nobody " + program + "play default --from 3 --to 2");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.errors.find("blush: --from 3.000000 --to 2.000000: not a part of a performance of "), 0U)
        << ran.errors;
}

TEST(Viewer, NamesABadFace) {
    const Ran ran = run(no_display + "DISPLAY=:nobody " + program + "play nothing.glb");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.errors.find("blush: nothing.glb: "), 0U) << ran.errors;
}

}  // namespace
