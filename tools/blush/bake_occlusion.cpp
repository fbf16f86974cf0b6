/// blush bake occlusion: how a face hides light from its own vertices.

#include <cstdio>
#include <iostream>

#include "runtime/bake/bake_occlusion.h"
#include "runtime/files/face_file.h"
#include "runtime/files/occlusion_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

struct Options {
    std::string face, output;
    OcclusionBake bake;
    bool rest_alone = false;
};

Status bake(Options options) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return face.error();
    if (options.bake.targets.empty() && !options.rest_alone) options.bake.targets = usual_occlusion_targets(*face);
    const Result<OcclusionSet> set = bake_occlusion(*face, options.bake);
    if (!set) return set.error();
    if (Status written = write_occlusion(options.output, *set); !written) return written;
    for (const OcclusionPose& pose : set->poses) {
        double sum = 0;
        for (const LightTransfer& transfer : pose.transfers) sum += openness(transfer);
        std::printf("%s: %.1f %% of the directions around %zu vertices are open\n",
                    pose.target.empty() ? "at rest" : pose.target.c_str(),
                    100 * sum / static_cast<double>(std::max<std::size_t>(1, pose.transfers.size())),
                    pose.transfers.size());
    }
    return Done{};
}

}  // namespace

void add_bake_occlusion(Command& bake_command) {
    auto options = std::make_shared<Options>();
    Command command = bake_command.subcommand(
        "occlusion", "How much light from around the face hides from its own vertices, for environments");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    command.option("-o,--output", &options->output, "The file; head.occlusion beside head.glb is found by itself")
        .required();
    command.option("--rays", &options->bake.rays, "Cast from each vertex in each pose")
        .range(16, 65'536)
        .shows_default();
    const Option targets = command.option("--pose", &options->bake.targets,
                                          "A target that opens or closes something; several, up to 7. Without any: "
                                          "jawOpen, eyeBlinkLeft and eyeBlinkRight where the face has them");
    command.flag("--rest-alone", options->rest_alone, "No pose but rest").excludes(targets);
    command.runs([options] {
        const Status baked = bake(*options);
        return baked ? 0 : fail(baked.error());
    });
}

}  // namespace blush::tool
