/// blush bake face: a head by a person's measures (docs/default_face.md).

#include "tools/blush/options.h"
#include "tools/make_face/face_command.h"

namespace blush::tool {

void add_bake_face(CLI::App& bake_command, int& exit_status) {
    auto options = std::make_shared<make_face::FaceCommand>();
    CLI::App* command = bake_command.add_subcommand("face", "A head with 52 targets by named measures of a person");
    options->add_to(*command);
    command->callback([options, &exit_status] {
        const Status status = options->run(asset_folder() / "presets");
        if (!status) exit_status = fail(status.error());
    });
}

}  // namespace blush::tool
