/// blush render: one frame into a file.

#include <iostream>

#include "runtime/files/output_file.h"
#include "runtime/offscreen.h"
#include "tools/blush/options.h"
#include "tools/blush/performing.h"

namespace blush::tool {
namespace {

struct Options {
    std::string face, output, size = "960x960";
    PoseOptions pose;
    PerformOptions perform;
    bool check_finite = false, force_effects = false;
    float yaw_degrees = 0, pitch_degrees = 0, exposure = 1, zoom = 1;
    LightOptions light;
};

int render(const Options& options) {
    const Result<Size> size = parse_size(options.size);
    if (!size) return fail(size.error());
    Result<std::unique_ptr<Stage>> stage = make_stage(options.face, options.pose);
    if (!stage) return fail(stage.error());
    Character& character = (*stage)->character;

    std::optional<BloodFlow> blood;
    if (Status performed = perform_moment(character.face(), character.rig(), options.perform, character.controls(),
                                          character.pose(), [&](const BloodFlow& flow) { blood = flow; });
        !performed) {
        return fail(performed.error());
    }
    character.follow_blood(blood ? &*blood : nullptr);

    const std::string ending = std::filesystem::path(options.output).extension().string();
    const bool linear = ending == ".exr" || ending == ".hdr";
    Result<Offscreen> offscreen = Offscreen::create((*stage)->device, size->width, size->height,
                                                    linear ? Output::linear_hdr : Output::display_srgb);
    if (!offscreen) return fail(offscreen.error());
    const float aspect = static_cast<float>(size->width) / static_cast<float>(size->height);
    OrbitCamera orbit = character.framing(aspect);
    orbit.yaw_radians = glm::radians(options.yaw_degrees);
    orbit.pitch_radians = glm::radians(options.pitch_degrees);
    View view = offscreen->view();
    orbit.distance /= options.zoom;
    view.camera = orbit.camera(aspect);
    Result<std::optional<Lighting>> lighting = options.light.lighting(character);
    if (!lighting) return fail(lighting.error());
    if (*lighting) view.lighting = &**lighting;
    view.exposure = options.exposure;
    view.time_seconds = options.perform.at_seconds;
    view.check_finite = options.check_finite;
    view.force_effects = options.force_effects;

    if (const int found = report_not_finite(draw_alone(character, view)); found != 0) return found;
    if (Status written = write_image(options.output, offscreen->read()); !written) return fail(written.error());
    std::cout << options.output << ": " << options.size << (linear ? ", linear radiance\n" : ", sRGB\n");
    return 0;
}

}  // namespace

void add_render(CLI::App& app, int& exit_status) {
    auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "Draw one frame without a window");
    command->add_option("FACE", options->face, "A .glb, .gltf or .obj file, or \"default\"")->required();
    options->pose.add_to(*command);
    options->perform.add_moment_to(*command);
    command->add_option("--size", options->size, "Width and height in pixels")->capture_default_str();
    command->add_option("--yaw", options->yaw_degrees, "Camera around the head, degrees; positive to the face's left")
        ->check(number_from(-360, 360));
    command->add_option("--pitch", options->pitch_degrees, "Camera up, degrees")->check(number_from(-90, 90));
    command->add_option("--zoom", options->zoom, "How many times closer the camera stands")
        ->check(number_from(0.01, 100));
    options->light.add_to(*command);
    command->add_option("--exposure", options->exposure, "Factor on radiance")->check(number_from(1e-4, 1e4));
    command
        ->add_option("-o,--output", options->output,
                     "A .png (sRGB) or .exr (linear radiance) file; .jpg, .tif and .hdr work too")
        ->required();
    command->add_flag("--check-finite", options->check_finite, "Scan what every pass writes for NaN and infinities");
    command->add_flag("--force-effects", options->force_effects, "Run effects that could be left out, too");
    command->callback([options, &exit_status] { exit_status = render(*options); });
}

}  // namespace blush::tool
