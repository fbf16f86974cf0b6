/// blush bake face: a head by a person's measures (docs/default_face.md).

#include "tools/blush/assets.h"
#include "tools/blush/commands.h"
#include "tools/make_face/face_command.h"

namespace blush::tool {

void add_bake_face(Command& bake_command) {
    auto options = std::make_shared<make_face::FaceCommand>();
    Command command = bake_command.subcommand("face", "A head with 52 targets by named measures of a person");
    options->add_to(command);
    command.runs([options] {
        const Status made = options->run(asset_folder() / "presets");
        return made ? 0 : fail(made.error());
    });
}

}  // namespace blush::tool
