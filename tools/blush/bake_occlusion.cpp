/// blush bake occlusion: how a face hides light from its own vertices.

#include <cstdio>
#include <iostream>

#include "runtime/bake/bake_occlusion.h"
#include "runtime/files/face_file.h"
#include "runtime/files/occlusion_file.h"
#include "tools/blush/options.h"

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

void add_bake_occlusion(CLI::App& bake_command, int& exit_status) {
    auto options = std::make_shared<Options>();
    CLI::App* command = bake_command.add_subcommand(
        "occlusion", "How much light from around the face hides from its own vertices, for environments");
    command->add_option("FACE", options->face, "A .glb, .gltf or .obj file, or \"default\"")->required();
    command->add_option("-o,--output", options->output, "The file; head.occlusion beside head.glb is found by itself")
        ->required();
    command->add_option("--rays", options->bake.rays, "Cast from each vertex in each pose")
        ->check(CLI::Range(16U, 65'536U))
        ->capture_default_str();
    auto* targets = command->add_option("--pose", options->bake.targets,
                                        "A target that opens or closes something; several, up to 7. Without any: "
                                        "jawOpen, eyeBlinkLeft and eyeBlinkRight where the face has them");
    command->add_flag("--rest-alone", options->rest_alone, "No pose but rest")->excludes(targets);
    command->callback([options, &exit_status] {
        if (Status baked = bake(*options); !baked) exit_status = fail(baked.error());
    });
}

}  // namespace blush::tool
