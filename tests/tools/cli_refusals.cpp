/// Bad input, as a user meets it: one sentence, exit status 2, nothing left behind.

#include <string_view>

#include "rig/names.h"
#include "tests/tools/cli_run.h"

#include <gmock/gmock.h>

namespace blush::test {
namespace {

/// A Live Link Face recording: all of ARKit's shapes, each row with JawOpen at one value and the others at 0.
std::string recording(const std::vector<float>& jaw_open, const std::string& line_end) {
    std::string text = "Timecode,BlendShapeCount";
    for (const std::string_view name : arkit_names) text += "," + std::string(name);
    text += line_end;
    for (std::size_t row = 0; row < jaw_open.size(); ++row) {
        text += "00:00:00:0" + std::to_string(row) + ".000," + std::to_string(arkit_names.size());
        for (const std::string_view name : arkit_names) {
            text += "," + (name == "jawOpen" ? std::to_string(jaw_open[row]) : "0");
        }
        text += line_end;
    }
    return text;
}

TEST_F(Cli, BadFacesAreNamed) {
    write("empty.glb", "");
    write("text.glb", "hello");
    write("cut.glb", bytes_of("face.glb").substr(0, 1000));
    write("face.obj", bytes_of("face.glb"));
    expect_refused("info nothing.glb", "nothing.glb: there is no such file");
    expect_refused("info .", ".: this is a folder, not a file");
    expect_refused("info empty.glb", "empty.glb: not a face file: it is empty (expected .glb, .gltf or .obj)");
    expect_refused("info text.glb",
                   "text.glb: not a face file: it is named .glb, but its content is neither GLB nor JSON");
    expect_refused("info cut.glb", "cut.glb: the GLB header says " + std::to_string(bytes_of("face.glb").size()) +
                                       " bytes, but the file has 1000");
    expect_refused("info face.obj", "face.obj: it is named .obj, but its content is GLB");
    for (const char* command : {"evaluate nothing.glb -o x.ply", "render nothing.glb -o x.png", "explain nothing.glb",
                                "play nothing.glb -o x.mp4", "accuracy nothing.glb -o report"}) {
        expect_refused(command, "nothing.glb: there is no such file");
    }
}

TEST_F(Cli, BadCommandsAreNamed) {
    expect_refused("", "A subcommand is required");
    const Ran wink = blush("wink");
    EXPECT_EQ(wink.exit_status, 2);
    EXPECT_THAT(wink.errors, testing::StartsWith("blush: there is no command \"wink\" (there are: info "));
    EXPECT_THAT(wink.errors, testing::EndsWith(")\n"));
    expect_refused("info", "FACE is required");
    expect_refused("render face.glb", "--output is required");
    expect_refused("evaluate face.glb -o x.ply --on tpu", "--on: tpu not in {cpu,gpu}");
}

TEST_F(Cli, BadControlsAreNamed) {
    const std::string evaluate = "evaluate face.glb -o x.ply --set ";
    expect_refused(evaluate + "jawOpne=1",
                   "--set jawOpne=1: face.glb has no control \"jawOpne\" (did you mean \"jawOpen\"?)");
    expect_refused(evaluate + "=1", "--set =1: face.glb has no control \"\"");
    expect_refused(evaluate + "jawOpen", "--set jawOpen: not NAME=VALUE");
    for (const char* number : {"nan", "inf", "1e99", "", "1x"}) {
        expect_refused(evaluate + "jawOpen=" + number,
                       "--set jawOpen=" + std::string(number) + ": \"" + number + "\" is not a finite number");
    }
}

TEST_F(Cli, BadSettingsAreNamed) {
    for (const char* command : {"evaluate face.glb -o x.ply", "render face.glb -o x.png", "explain face.glb"}) {
        const std::string with = std::string(command) + " --setting ";
        expect_refused(with + "deformation.method=wat",
                       "--setting deformation.method=wat: setting deformation.method has no choice \"wat\" (there are: "
                       "sparse, passes)");
        expect_refused(with + "deformation", "--setting deformation: not NAME=CHOICE");
    }
}

TEST_F(Cli, BadSizesAreNamed) {
    for (const char* size : {"0x0", "100000x100000", "16385x1", "1x99999999999999999999999"}) {
        for (const char* command : {"render face.glb -o x.png", "play face.glb -o x.mp4"}) {
            expect_refused(std::string(command) + " --size=" + size,
                           "--size " + std::string(size) + ": a side may be 1 to 16384 pixels");
        }
    }
    for (const char* size : {"abc", "-5x3", "64", "64x", "64x64x", "64X64"}) {
        expect_refused(std::string("render face.glb -o x.png --size=") + size,
                       "--size " + std::string(size) + ": not WIDTHxHEIGHT in pixels, like 960x960");
    }
}

TEST_F(Cli, NumbersThatAreNoneAreNamed) {
    const std::string play = "play face.glb -o f/%d.png --size 64x64 ";
    for (const char* number : {"nan", "inf", "-1", "abc"}) {
        const std::string said = std::string("\"") + number + "\" is not a number from ";
        expect_refused(play + "--from=" + number, "--from: " + said + "0 to 1e+06");
        expect_refused(play + "--to=" + number, "--to: " + said + "0 to 1e+06");
        expect_refused(play + "--fps=" + number, "--fps: " + said + "0.01 to 1000");
        expect_refused(std::string("render face.glb -o x.png --exposure=") + number,
                       "--exposure: " + said + "0.0001 to 10000");
    }
    expect_refused(play + "--fps 0", "--fps: \"0\" is not a number from 0.01 to 1000");
    expect_refused("render face.glb -o x.png --yaw nan", "--yaw: \"nan\" is not a number from -360 to 360");
    expect_refused("render face.glb -o x.png --pitch nan", "--pitch: \"nan\" is not a number from -90 to 90");
    expect_refused(play + "--from 3", "--from 3.000000 --to 0.200000: not a part of a performance of 0.200000 seconds");
    expect_refused(play + "--from 0.1 --to 0",
                   "--from 0.100000 --to 0.000000: not a part of a performance of 0.200000 seconds");
}

TEST_F(Cli, BadOutputsAreNamedAndNothingIsLeft) {
    std::filesystem::create_directory(path("taken.png"));
    std::filesystem::create_directory(path("taken.ply"));
    const std::string small = " --size 64x64";
    expect_refused("evaluate face.glb -o no/x.ply", "no/x.ply: cannot be written: the folder no does not exist");
    expect_refused("evaluate face.glb -o taken.ply", "taken.ply: cannot be written: it is a folder");
    expect_refused("evaluate face.glb -o x.stl", "x.stl: a surface is written as .ply or .obj");
    expect_refused("render face.glb -o no/x.png" + small, "no/x.png: cannot be written: the folder no does not exist");
    expect_refused("render face.glb -o taken.png" + small, "taken.png: cannot be written: it is a folder");
    expect_refused("render face.glb -o x.wat" + small, "x.wat: no picture format is known by the ending \".wat\"");
    for (const char* pattern :
         {"f/x.png", "f/%d%d.png", "f/%s.png", "f/%.png", "f/%", "f/%999d.png", "f%d/x.png", "x.avi"}) {
        expect_refused(
            std::string("play face.glb -o ") + pattern + small,
            "-o " + std::string(pattern) + ": not a .mp4 or .gif, nor a numbered picture like frames/%05d.png or .exr");
    }
    expect_refused("play face.glb -o f/%d.wat" + small, "f/0.wat: no picture format is known by the ending \".wat\"");
    expect_refused("play face.glb -o a/b/%d.png" + small, "a/b: this folder cannot be made: No such file or directory");
    expect_refused("play face.glb -o no/x.mp4" + small, "no/x.mp4: cannot be written: the folder no does not exist");
    expect_refused("accuracy face.glb -o no/report",
                   "no/report: this folder cannot be made: No such file or directory");
    // The list of what there is grows with every effect.
    const Ran wat = blush("accuracy face.glb --effect wat -o report");
    EXPECT_EQ(wat.exit_status, 2);
    EXPECT_THAT(wat.errors,
                testing::StartsWith("blush: --effect: no effect is called \"wat\" (there are: deformation, "));
}

TEST_F(Cli, ABadContactSheetIsNamedBeforeAnythingIsDrawn) {
    const std::string play = "play face.glb -o f/%d.png --contact-sheet ";
    expect_refused(play + "no/c.png", "no/c.png: cannot be written: the folder no does not exist");
    expect_refused(play + "c.wat", "--contact-sheet c.wat: a contact sheet is a .png");
    expect_refused(play + "c.png --size 5000x64",
                   "--contact-sheet c.png: its moments may have 4096x8192 pixels at most; --size says 5000x64");
    expect_refused("play face.glb -o f/%d.exr --contact-sheet c.png",
                   "--contact-sheet goes with pictures for a display, not with .exr");
}

TEST_F(Cli, BadPerformancesAreNamed) {
    write("no_time.csv", "BlendShapeCount,JawOpen\n1,0\n");
    const std::string whole = recording({0, 1}, "\n");
    write("cut.csv", whole.substr(0, whole.rfind(",0\n")));
    write("shapeless.csv", "Timecode,BlendShapeCount,JawOpen\n00:00:00:00.000,1,0\n");
    write("cut.json", R"({"blush_performance":1,)");
    const std::string play = "play face.glb -o f/%d.png --size 64x64 --performance ";
    expect_refused(play + "wat",
                   "--performance wat: neither a file, nor an animation of face.glb, nor shipped (there are: "
                   "compliment, first_light, six_feelings)");
    expect_refused(play + "no_time.csv",
                   "no_time.csv: row 1 has no column 'Timecode': this is neither a Live Link Face CSV "
                   "nor a blush performance (JSON)");
    expect_refused(play + "cut.csv",
                   "cut.csv: row 3, column '" + std::string(arkit_names.back()) + "': the row ends before it");
    expect_refused(play + "shapeless.csv", "shapeless.csv: row 1 has no column for the shape 'eyeBlinkLeft'");
    expect_refused(play + "cut.json",
                   "cut.json: line 1, column 24: not valid JSON: unexpected end of input; expected string literal");
    expect_refused(play + "face.glb", "face.glb: not a performance: it is not a text file");
}

TEST_F(Cli, WindowsRecordingsPlayAsTheyAre) {
    write("plain.csv", recording({0, 1}, "\n"));
    write("windows.csv", "\xEF\xBB\xBF" + recording({0, 1}, "\r\n"));
    expect_works("play face.glb --performance plain.csv --size 64x64 -o p%d.png");
    expect_works("play face.glb --performance windows.csv --size 64x64 -o w%d.png");
    expect_same("p0.png", "w0.png");
    expect_same("p1.png", "w1.png");
    EXPECT_NE(bytes_of("p0.png"), bytes_of("p1.png"));
}

TEST_F(Cli, AFullDiskIsNoticed) {
    expect_refused("info face.glb >/dev/full", "standard output: cannot be written");
    // No file may pass one block: the disk is full for it.
    const Ran ran = blush("evaluate face.glb -o x.ply", "ulimit -f 1; trap '' XFSZ; ");
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.errors, "blush: x.ply: cannot be written: the disk refused it\n");
    EXPECT_EQ(listing(path("")), std::set<std::string>{"face.glb"});
}

TEST_F(Cli, AClosedPipeIsNoCrash) {
    const Ran ran = run("{ '" BLUSH_PROGRAM "' info face.glb; echo $? >status; } | true", path(""));
    EXPECT_EQ(ran.exit_status, 0);
    const std::string status = bytes_of("status");
    EXPECT_TRUE(status == "0\n" || status == "2\n") << status;  // it may have finished before the pipe closed
}

TEST_F(Cli, AnInterruptedVideoLeavesNothing) {
    if (run("command -v ffmpeg").exit_status != 0) GTEST_SKIP() << "no ffmpeg here";
    // The signal is sent when the first progress has been read, with most of a long performance to go.
    const Ran ran = run("mkfifo said; '" BLUSH_PROGRAM
                        "' play face.glb --fps 100 --to 10 --size 64x64 -o x.mp4 2>said & "
                        "pid=$!; exec 3<said; read first <&3; kill -TERM $pid; cat <&3; wait $pid",
                        path(""));
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_THAT(ran.output, ::testing::HasSubstr("blush: x.mp4: stopped after "));
    EXPECT_EQ(listing(path("")), (std::set<std::string>{"face.glb", "said"}));
}

TEST_F(Cli, MakeFaceRefusesWithASentence) {
    const auto refused = [&](const std::string& arguments) {
        const Ran ran = run("'" MAKE_FACE_PROGRAM "' " + arguments, path(""));
        EXPECT_EQ(ran.exit_status, 2) << arguments;
        EXPECT_EQ(listing(path("")), std::set<std::string>{"face.glb"});
        return ran.errors;
    };
    EXPECT_EQ(refused("-o no/x.glb"), "make_face: no/x.glb: cannot be written: No such file or directory\n");
    EXPECT_EQ(refused("-o x.glb --vertices 5"), "make_face: --vertices: Value 5 not in range 5000 to 1000000\n");
    EXPECT_EQ(refused(""), "make_face: --output is required\n");
    EXPECT_EQ(refused("-o x.glb --set jaw_with=1"),
              "make_face: --set: no parameter \"jaw_with\" of the face (did you mean \"jaw_width\"?)\n");
    EXPECT_EQ(refused("-o x.glb --set jaw_width=9"), "make_face: --set: jaw_width may go from -3.0 to 3.0 (sd)\n");
    EXPECT_EQ(refused("-o x.glb --preset nobody --presets '" BLUSH_SOURCE_DIR "/assets/presets'"),
              "make_face: --preset nobody: there are amara, arthur, jonas, mei\n");
}

}  // namespace
}  // namespace blush::test
