/// make_face: writes the default face, made by this project's own code from no one else's data. The build runs it;
/// `blush bake face` is the same with the shipped presets.

#include <cstdio>
#include <exception>

#include "tools/make_face/face_command.h"

int main(int argc, char** argv) try {
    CLI::App app{"Writes the default face as a binary glTF file: 52 ARKit targets, eyes, teeth and tongue."};
    blush::make_face::FaceCommand command;
    command.add_to(app);
    std::string presets = "assets/presets";
    app.add_option("--presets", presets, "Folder of the presets")->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help
        std::fprintf(stderr, "make_face: %s\n", error.what());
        return 2;
    }
    if (const blush::Status status = command.run(presets); !status) {
        std::fprintf(stderr, "make_face: %s\n", status.error().message.c_str());
        return 2;
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "make_face: %s\n", error.what());
    return 2;
}
