/// Scripts, life and events on the command line.

#include <string>

#include <gmock/gmock.h>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

using testing::HasSubstr;

TEST_F(Cli, AScriptMovesTheFaceAsSettingItsControlsDoes) {
    write("jaw.lua", "feel('jawOpen', 0.75, {over = 1, ease = 'linear'})");
    expect_works("evaluate face.glb --script jaw.lua --life off --at 1 -o script.ply");
    expect_works("evaluate face.glb --set jawOpen=0.75 -o set.ply");
    expect_same("script.ply", "set.ply");
    expect_works("evaluate face.glb --script jaw.lua --life off -o beginning.ply");
    expect_works("evaluate face.glb -o rest.ply");
    expect_same("beginning.ply", "rest.ply");
    expect_works("evaluate face.glb --script jaw.lua --life off --at 1 --on gpu -o gpu.ply");
    expect_same("gpu.ply", "set.ply");
}

TEST_F(Cli, AScriptIsTheSameInEveryRun) {
    write("restless.lua",
          "local t = {a = 1, b = 2, c = 3}\n"
          "while true do for k, v in pairs(t) do feel('jawOpen', random() * v / 3) wait(0.1) end end");
    for (const char* name : {"one.ply", "two.ply"}) {
        expect_works("evaluate face.glb --script restless.lua --seed 5 --at 4.3 -o " + std::string(name));
    }
    expect_same("one.ply", "two.ply");
    expect_works("evaluate face.glb --script restless.lua --seed 6 --at 4.3 -o other.ply");
    EXPECT_NE(bytes_of("one.ply"), bytes_of("other.ply"));
}

TEST_F(Cli, EventsReachTheScriptAndPrintsTheUser) {
    write("poke.lua", "on('poke', function() set('jawOpen', 1) print('ouch', now()) end)");
    const Ran ran = blush("evaluate face.glb --script poke.lua --life off --event 0.5=poke --at 1 -o poked.ply");
    EXPECT_EQ(ran.exit_status, 0);
    EXPECT_EQ(ran.errors, "script: ouch\t0.5\n");
    expect_works("evaluate face.glb --set jawOpen=1 -o set.ply");
    expect_same("poked.ply", "set.ply");
}

TEST_F(Cli, AScriptIsPlayedToItsEnd) {
    write("short.lua", "print('begins') wait(0.1) feel('jawOpen', 1, {over = 0.1})");
    const Ran ran = blush("play face.glb --script short.lua --fps 10 --size 16x16 -o '%d.png'");
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("3 frames"));
    EXPECT_EQ(ran.errors.find("begins"), ran.errors.rfind("begins")) << "finding the end prints nothing";
}

TEST_F(Cli, WordsStandInThePictureUnlessTheyAreLeftOut) {
    write("words.lua", "say('Hello there', {over = 1})");
    write("silence.lua", "wait(1)");
    const std::string play = "play face.glb --life off --to 0 --size 96x96 ";
    expect_works(play + "--script words.lua -o 'said%d.png'");
    expect_works(play + "--script words.lua --no-captions -o 'left_out%d.png'");
    expect_works(play + "--script silence.lua -o 'silent%d.png'");
    expect_same("left_out0.png", "silent0.png");
    EXPECT_NE(bytes_of("said0.png"), bytes_of("silent0.png"));
}

TEST_F(Cli, BadScriptsAreNamed) {
    write("syntax.lua", "feel('jawOpen', 1");
    write("name.lua", "wait(0.2)\nfeel('jawOpne', 1)");
    write("endless.lua", "\nwhile true do end");
    const std::string evaluate = "evaluate face.glb -o x.ply --at 1 --script ";
    expect_refused(
        evaluate + "nothing.lua",
        "--script nothing.lua: neither a file nor shipped (there are: a_minute, conversation, fear_into_anger, idle, "
        "laughter, poke, shy_smile)");
    expect_refused(evaluate + "syntax.lua", "syntax.lua:1: ')' expected near <eof>");
    expect_refused(evaluate + "name.lua",
                   "name.lua:2: feel: the face has no control 'jawOpne' (did you mean 'jawOpen'?)");
    expect_refused(evaluate + "endless.lua",
                   "endless.lua:2: the script did not come to a wait() or its end within "
                   "200000 instructions of one step");
    expect_refused("play face.glb --script name.lua -o x.mp4",
                   "name.lua:2: feel: the face has no control 'jawOpne' (did you mean 'jawOpen'?)");
    expect_refused(evaluate + "name.lua --event poke", "--event poke: not SECONDS=NAME, like 2.5=poke");
    expect_refused(evaluate + "name.lua --blood fast",
                   "--blood fast: not at-once, slow, or slow:SPEED with a speed from 0.01 to 1000");
}

TEST_F(Cli, LintOfScripts) {
    write("good.lua", "feel('joy', 1)");
    write("odd.lua", "\nfeel('joyy', 1)");
    EXPECT_EQ(blush("lint good.lua").output, "good.lua: nothing odd\n");
    EXPECT_EQ(blush("lint odd.lua").output, "odd.lua: line 2: there is no control 'joyy' (did you mean 'joy'?)\n");
    expect_refused("lint nothing.lua", "nothing.lua: there is no such file");
}

}  // namespace
}  // namespace blush::test
