/// blush import: public heads to one glTF file.

#include <iostream>

#include "runtime/files/import/import_head.h"
#include "runtime/files/output_file.h"
#include "tools/blush/options.h"

namespace blush::tool {
namespace {

struct Options {
    std::string input;
    std::filesystem::path output;
    MakeHumanOptions makehuman;
};

void add_files(CLI::App& command, Options& options) {
    command.add_option("INPUT", options.input, "A folder, or an archive (.tar.xz, .zip, ...) of one")->required();
    command.add_option("-o,--output", options.output, "The .glb file to write")->required();
}

int finish(const Options& options, const Result<ImportedHead>& head) {
    if (!head) return fail(head.error());
    if (Status written = write_file(options.output, head->glb); !written) return fail(written.error());
    std::cout << options.output.string() << ": " << head->vertices << " vertices, " << head->triangles << " triangles, "
              << head->targets << " targets\n";
    for (const std::string& note : head->notes) std::cout << "  " << note << "\n";
    return 0;
}

}  // namespace

void add_import(CLI::App& app, int& exit_status) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("import", "Turn a public head into one glTF file (docs/heads.md)");
    command->require_subcommand(1);

    CLI::App* ict = command->add_subcommand("ict", "USC ICT-FaceKit: its OBJ files");
    add_files(*ict, *options);
    ict->callback([options, &exit_status] { exit_status = finish(*options, import_ict(options->input)); });

    CLI::App* makehuman = command->add_subcommand("makehuman", "MakeHuman: base mesh, targets, parts, textures");
    add_files(*makehuman, *options);
    makehuman
        ->add_option("--shape", options->makehuman.shapes,
                     "A .target file by its name, applied to the base mesh: \"caucasian-male-young=0.8\"")
        ->delimiter(',');
    makehuman->callback([options, &exit_status] {
        exit_status = finish(*options, import_makehuman(options->input, options->makehuman));
    });
}

}  // namespace blush::tool
