#pragma once
/// Portrait: one face, its scene and its view together, for programs that make pictures of a face and for studies.
/// Draws as any host does: by Scene::draw.

#include <filesystem>
#include <optional>
#include <string_view>

#include "runtime/scene.h"

namespace blush {

class Portrait {
public:
    static Result<Portrait> load(const Device& device, const std::filesystem::path& path);
    static Result<Portrait> create(const Device& device, Face face,
                                   const std::optional<RigDescription>& description = std::nullopt);
    static Result<Portrait> create(const Device& device, const FaceAsset& asset);

    const Face& face() const { return character_.face(); }
    const Rig& rig() const { return character_.rig(); }
    std::optional<ControlId> control(std::string_view name) const { return character_.control(name); }
    void set(ControlId control, float value) { character_.set(control, value); }
    std::span<float> controls() { return character_.controls(); }
    Pose& pose() { return character_.pose(); }
    void follow_blood(const BloodFlow* blood) { character_.follow_blood(blood); }

    /// A setting of whichever of the three owns it.
    Status set(std::string_view setting, std::string_view choice);

    /// The same face with other maps; controls, settings and place stay.
    void set_appearance(FaceAppearance appearance);
    void set_occlusion(std::optional<OcclusionSet> occlusion);

    OrbitCamera framing(float aspect) const { return character_.asset().framing(aspect); }
    const FrameReport& draw(const ViewFrame& frame) { return scene_.draw(view_, frame); }
    Scene::Surface read_deformed() { return scene_.read_deformed(character_); }

    Character& character() { return character_; }
    Scene& scene() { return scene_; }
    View& view() { return view_; }
    CharacterState& state() { return character_.state(); }
    FrameState& frame() { return view_.state(); }
    const FrameReport& report() const { return Scene::report(view_); }

private:
    Portrait(Character character, Scene scene, View view)
        : character_(std::move(character)), scene_(std::move(scene)), view_(std::move(view)) {}
    void show(const FaceAsset& asset);

    Character character_;
    Scene scene_;
    View view_;
};

}  // namespace blush
