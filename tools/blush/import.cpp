/// blush import: public heads to one glTF file.

#include <iostream>

#include "runtime/files/import/import_head.h"
#include "runtime/files/output_file.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

struct Options {
    std::string input, output;
    MakeHumanOptions makehuman;
};

void add_files(Command& command, Options& options) {
    command.option("INPUT", &options.input, "A folder, or an archive (.tar.xz, .zip, ...) of one").required();
    command.option("-o,--output", &options.output, "The .glb file to write").required();
}

int finish(const Options& options, const Result<ImportedHead>& head) {
    if (!head) return fail(head.error());
    if (Status written = write_file(options.output, head->glb); !written) return fail(written.error());
    std::cout << options.output << ": " << head->vertices << " vertices, " << head->triangles << " triangles, "
              << head->targets << " targets\n";
    for (const std::string& note : head->notes) std::cout << "  " << note << "\n";
    return 0;
}

}  // namespace

void add_import(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("import", "Turn a public head into one glTF file (docs/heads.md)");
    command.needs_a_subcommand();

    Command ict = command.subcommand("ict", "USC ICT-FaceKit: its OBJ files");
    add_files(ict, *options);
    ict.runs([options] { return finish(*options, import_ict(options->input)); });

    Command makehuman = command.subcommand("makehuman", "MakeHuman: base mesh, targets, parts, textures");
    add_files(makehuman, *options);
    makehuman
        .option("--shape", &options->makehuman.shapes,
                "A .target file by its name, applied to the base mesh: \"caucasian-male-young=0.8\"")
        .split_at_commas();
    makehuman.runs([options] { return finish(*options, import_makehuman(options->input, options->makehuman)); });
}

}  // namespace blush::tool
