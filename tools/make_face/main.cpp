/// make_face: writes the default face, made by this project's own code from no one else's data. The build runs it;
/// `blush bake face` is the same with the shipped presets.

#include <cstdio>
#include <exception>

#include "tools/make_face/face_command.h"

namespace {

int fail(const char* sentence) {
    std::fprintf(stderr, "make_face: %s\n", sentence);
    return blush::bad_input;
}

}  // namespace

int main(int argc, char** argv) try {
    blush::CommandLine words(
        "make_face", "Writes the default face as a binary glTF file: 52 ARKit targets, eyes, teeth and tongue.");
    blush::Command command = words.command();
    blush::make_face::FaceCommand face;
    face.add_to(command);
    std::string presets = "assets/presets";
    command.option("--presets", &presets, "Folder of the presets").shows_default();
    command.runs([&] {
        const blush::Status made = face.run(presets);
        return made ? 0 : fail(made.error().message.c_str());
    });
    return words.run(argc, argv);
} catch (const std::exception& error) {
    return fail(error.what());
}
