/// make_face: writes the default face, made by this project's own code from no one else's data.

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "tools/make_face/build_face.h"

int main(int argc, char** argv) try {
    CLI::App app{"Writes the default face as a binary glTF file: 52 ARKit targets, eyes, teeth and tongue."};
    std::string path;
    std::size_t vertices = 22'000;
    app.add_option("-o,--output", path, "the .glb file to write")->required();
    app.add_option("--vertices", vertices, "vertices of the skin, roughly")
        ->check(CLI::Range(6'000, 30'000))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help
        std::fprintf(stderr, "make_face: %s\n", error.what());
        return 2;
    }
    // An unwritable path is found out before the seconds of work.
    if (const blush::Status status = blush::make_face::check_writable(path); !status) {
        std::fprintf(stderr, "make_face: %s\n", status.error().message.c_str());
        return 2;
    }
    const std::string bytes = blush::make_face::glb_bytes(blush::make_face::build_face(vertices));
    if (const blush::Status status = blush::make_face::write_file(path, bytes); !status) {
        std::fprintf(stderr, "make_face: %s\n", status.error().message.c_str());
        return 2;
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "make_face: %s\n", error.what());
    return 2;
}
