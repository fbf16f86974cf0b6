#include "tools/blush/stage.h"

#include "runtime/files/face_file.h"
#include "runtime/files/occlusion_file.h"
#include "runtime/files/rig_description_file.h"
#include "runtime/frame/character_state.h"
#include "tools/blush/assets.h"

namespace blush::tool {

namespace {

/// Two frames for one picture: an effect is on where either ran it.
FrameReport united(FrameReport first, const FrameReport& second) {
    for (std::size_t e = 0; e < first.effects.size(); ++e) {
        if (!first.effects[e].on) first.effects[e] = second.effects[e];
    }
    first.passes.insert(first.passes.end(), second.passes.begin(), second.passes.end());
    first.deltas_added += second.deltas_added;
    first.triangles_drawn += second.triangles_drawn;
    if (!first.not_finite) first.not_finite = second.not_finite;
    first.incomplete = second.incomplete;
    return first;
}

}  // namespace

Result<FaceFiles> load_face_files(const std::string& face_name, const std::string& rig_file) {
    Result<Face> face = load_face(face_path(face_name));
    if (!face) return face.error();
    Result<RigDescription> rig = find_rig_description(*face, rig_file);
    if (!rig) return rig.error();
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(face->path));
    if (!appearance) return appearance.error();
    Result<std::optional<OcclusionSet>> occlusion = find_occlusion(*face);
    if (!occlusion) return occlusion.error();
    return FaceFiles{*std::move(face), *std::move(rig), *std::move(appearance), *std::move(occlusion)};
}

Result<Portrait> make_character(const Device& device, FaceFiles files, const PoseOptions& pose) {
    const Result<FaceAsset> asset =
        FaceAsset::create(std::move(files.face), files.rig, std::move(files.appearance), std::move(files.occlusion));
    if (!asset) return asset.error();
    Result<Portrait> character = Portrait::create(device, *asset);
    if (!character) return character;
    if (Status set = pose.apply(character->face(), character->rig(), character->controls()); !set) return set.error();
    const auto apply_setting = [&](std::string_view name, std::string_view value) {
        return character->set(name, value);
    };
    if (Status set = pose.apply_settings(apply_setting); !set) return set.error();
    return character;
}

Result<std::unique_ptr<Stage>> make_stage(const std::string& face, const PoseOptions& pose) {
    Result<FaceFiles> files = load_face_files(face, pose.rig_file);
    if (!files) return files.error();
    Result<Device> device = Device::headless();
    if (!device) return device.error();
    Result<Portrait> character = make_character(*device, *std::move(files), pose);
    if (!character) return character.error();
    return std::make_unique<Stage>(Stage{*std::move(device), *std::move(character)});
}

double millimetres_a_unit(Portrait& character) {
    const double set = character.state().settings.number("scattering", "millimetres_a_unit");
    return set > 0 ? set : character.state().facts_of_face.scale.millimetres_a_unit;
}

FrameReport draw_alone(Portrait& character, ViewFrame view) {
    view.cut = true;
    FrameReport report = character.draw(view);
    view.cut = false;
    return report.incomplete ? united(std::move(report), character.draw(view)) : report;
}

Status finite(const FrameReport& report) {
    if (report.not_finite) return Error{"--check-finite: " + report.not_finite->sentence()};
    return Done{};
}

Playback::Playback(Portrait& character, PerformerParts parts)
    : character_(&character), performer_(character.rig(), std::move(parts)) {
    character_->follow_blood(performer_.blood());
}

Status Playback::seek(double time_seconds) {
    Status played = performer_.seek(time_seconds);
    performer_.write(character_->controls(), character_->pose());
    return played;
}

}  // namespace blush::tool
