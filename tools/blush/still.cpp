#include "tools/blush/still.h"

#include "tools/blush/plan.h"

namespace blush::tool {

void StillOptions::add_to(Command& command) {
    command.option("FACE", &face, "A .glb, .gltf or .obj file, or \"default\"").required();
    pose.add_to(command);
    perform.add_moment_to(command);
    shot.add_to(command);
    command.option("--report", &report,
                   "A .json file for what the frame ran and left out, as explain --json prints it");
}

Result<Still> draw_still(const StillOptions& options) {
    const Result<Size> size = parse_size(options.shot.size);
    if (!size) return size.error();
    Result<std::unique_ptr<Stage>> stage = make_stage(options.face, options.pose);
    if (!stage) return stage.error();
    Portrait& character = (*stage)->character;
    Result<PerformerParts> parts =
        options.perform.parts(character.face(), character.rig(), character.controls(), std::nullopt);
    if (!parts) return parts.error();
    Playback playback(character, *std::move(parts));
    if (Status played = playback.seek(options.perform.at_seconds); !played) return played.error();
    Result<Shot> shot = Shot::make(**stage, *size, options.shot, output_of(options.output));
    if (!shot) return shot.error();
    const FrameReport report = shot->draw(options.perform.at_seconds, 0, true);
    if (Status good = finite(report); !good) return good.error();
    return Still{shot->read(), plan_of(character, report)};
}

}  // namespace blush::tool
