#include "tools/blush/shot.h"

namespace blush::tool {

void ShotOptions::add_to(Command& command) {
    command.option("--size", &size, "Width and height in pixels").shows_default();
    command.option("--yaw", &yaw_degrees, "Camera around the head, degrees; positive to the face's left")
        .range(-360, 360);
    command.option("--pitch", &pitch_degrees, "Camera up, degrees").range(-90, 90);
    command.option("--zoom", &zoom, "How many times closer the camera stands").range(0.01, 100);
    light.add_to(command);
    command.option("--exposure", &exposure, "Factor on radiance").range(1e-4, 1e4);
    command.flag("--check-finite", check_finite, "Scan what every pass writes for NaN and infinities");
    command.flag("--force-effects", force_effects, "Run effects that could be left out, too");
}

OrbitCamera ShotOptions::camera(const Portrait& character, float aspect) const {
    OrbitCamera orbit = character.framing(aspect);
    orbit.yaw_radians = glm::radians(yaw_degrees);
    orbit.pitch_radians = glm::radians(pitch_degrees);
    orbit.distance /= zoom;
    return orbit;
}

void ShotOptions::apply(ViewFrame& view) const {
    view.exposure = exposure;
    view.check_finite = check_finite;
    view.force_effects = force_effects;
}

Output output_of(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".exr" || ending == ".hdr" ? Output::linear_hdr : Output::display_srgb;
}

Result<Shot> Shot::make(Stage& stage, Size size, const ShotOptions& options, Output output) {
    Result<Offscreen> offscreen = Offscreen::create(stage.device, size.width, size.height, output);
    if (!offscreen) return offscreen.error();
    Result<std::optional<Lighting>> lighting =
        options.light.lighting(stage.character.face(), millimetres_a_unit(stage.character));
    if (!lighting) return lighting.error();
    Shot shot(stage, *std::move(offscreen), *std::move(lighting));
    shot.view_.camera = options.camera(stage.character, size.aspect()).camera(size.aspect());
    options.apply(shot.view_);
    return shot;
}

FrameReport Shot::draw(double time_seconds, std::uint32_t frame_number, bool alone) {
    view_.lighting = lighting_ ? &*lighting_ : nullptr;
    view_.time_seconds = time_seconds;
    view_.frame_number = frame_number;
    return alone ? draw_alone(stage_->character, view_) : stage_->character.draw(view_);
}

}  // namespace blush::tool
