#pragma once
/// From options to a face on a device, in its pose, moved by what plays: the one way for all commands.

#include <memory>
#include <optional>
#include <string>

#include "runtime/measure/portrait.h"
#include "runtime/script/performer.h"
#include "tools/blush/pose_options.h"

namespace blush::tool {

/// A face and what stands beside it. Read before there is a device: a bad file is named on a machine without GL too.
struct FaceFiles {
    Face face;
    RigDescription rig;
    FaceAppearance appearance;
    std::optional<OcclusionSet> occlusion;
};
/// rig_file: a rig description; empty: the one beside the face, or by the names of its targets.
Result<FaceFiles> load_face_files(const std::string& face, const std::string& rig_file);

/// With its controls and settings as the options say.
Result<Portrait> make_character(const Device& device, FaceFiles files, const PoseOptions& pose);

/// A headless device and a character on it.
struct Stage {
    Device device;
    Portrait character;
};
Result<std::unique_ptr<Stage>> make_stage(const std::string& face, const PoseOptions& pose);

/// As its settings or the face itself have it.
double millimetres_a_unit(Portrait& character);

/// Draws a picture that stands alone: what was drawn before does not show, and a mode that needs two frames gets them.
/// The report is of all that was run for it.
FrameReport draw_alone(Portrait& character, ViewFrame view);

/// Error: the finding of --check-finite.
Status finite(const FrameReport& report);

/// A performer on a character.
class Playback {
public:
    /// The character stays at its place as long as this lives.
    Playback(Portrait& character, PerformerParts parts);
    ~Playback() { character_->follow_blood(nullptr); }
    Playback(const Playback&) = delete;
    Playback& operator=(const Playback&) = delete;

    Performer& performer() { return performer_; }
    /// Sets the character to a time. Error: the script's.
    Status seek(double time_seconds);

private:
    Portrait* character_;
    Performer performer_;
};

}  // namespace blush::tool
