#pragma once
/// From options to a picture of a stage: its size, the camera, the lights, the exposure.

#include <filesystem>
#include <optional>
#include <string>

#include "runtime/offscreen.h"
#include "tools/blush/light_options.h"
#include "tools/blush/picture_size.h"
#include "tools/blush/stage.h"

namespace blush::tool {

struct ShotOptions {
    std::string size;
    LightOptions light;
    float yaw_degrees = 0, pitch_degrees = 0, zoom = 1, exposure = 1;
    bool check_finite = false, force_effects = false;

    void add_to(Command& command);
    /// Frames the face from where the options place the camera.
    OrbitCamera camera(const Portrait& character, float aspect) const;
    /// All that the options say beside camera, size and lights.
    void apply(ViewFrame& view) const;
};

/// What a file of that ending takes: .exr and .hdr hold radiance.
Output output_of(const std::filesystem::path& file);

class Shot {
public:
    /// Error: the lights', or a size that the device does not draw.
    static Result<Shot> make(Stage& stage, Size size, const ShotOptions& options, Output output);

    /// The stage as it stands now. alone: not the frame after the one drawn before.
    FrameReport draw(double time_seconds, std::uint32_t frame_number, bool alone);
    /// What was drawn.
    Image read() const { return offscreen_.read(); }
    Size size() const { return {view_.width, view_.height}; }
    Output output() const { return view_.output; }

private:
    Shot(Stage& stage, Offscreen offscreen, std::optional<Lighting> lighting)
        : stage_(&stage), offscreen_(std::move(offscreen)), lighting_(std::move(lighting)), view_(offscreen_.view()) {}

    Stage* stage_;
    Offscreen offscreen_;
    std::optional<Lighting> lighting_;
    ViewFrame view_;
};

}  // namespace blush::tool
