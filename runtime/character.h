#pragma once
/// Character: one face that stands in scenes, with controls to set.

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "rig/head/sockets.h"
#include "rig/motion/blood_flow.h"
#include "rig/result.h"
#include "rig/vectors.h"
#include "runtime/device.h"
#include "runtime/face_asset.h"
#include "runtime/surface.h"
#include "runtime/surface_point.h"

namespace blush {

struct CharacterState;

/// An instance of an asset: controls, pose, place, deformed surface. What is on the GPU for the asset is made for the
/// first character on a device that shows it, and shared by all of them. Its GL objects go with it, whatever context is
/// current then; scenes forget it by themselves.
class Character {
public:
    /// Error: the face does not fit the device, in one sentence.
    static Result<Character> create(const Device& device, const FaceAsset& asset);

    const FaceAsset& asset() const;
    const Face& face() const { return asset().face(); }
    const Rig& rig() const { return asset().rig(); }

    /// A control by its name or any of its usual spellings; resolve once, then set by id.
    std::optional<ControlId> control(std::string_view name) const { return rig().find(name); }
    /// A value that is not finite counts as 0. A control of another rig is passed over.
    void set(ControlId control, float value);
    /// All controls of the rig at once, to be written in place (for BoundPerformance::sample).
    std::span<float> controls();
    /// The pose that node animations write to; its weights and angles come from the controls at the next draw.
    Pose& pose();

    /// Lets slow blood (rig/motion/blood_flow.h) say where the blood is instead of the pose; null: the pose again. It
    /// must outlive its use here.
    void follow_blood(const BloodFlow* blood);

    /// Where its file's space stands in the world, with whatever turn and scale; the identity at first. What is not
    /// finite counts as the identity.
    void place(const DMat4& world_from_face);
    const DMat4& placed() const;

    /// Joints from the host's skeleton, in place of the face's own nodes: skinned_from_mesh of each joint of each skin,
    /// skins one after the other in file order, in the file's space. None: the face's own nodes again. Status: another
    /// number of joints than the face has.
    Status set_joints(std::span<const Mat4> skinned_from_mesh);

    /// World matrix of a socket, as controls, nodes, joints and place stand now, whatever was drawn last. At rest it is
    /// placed() moved to where the part turns (the jaw: to the middle of the chin), with the file's axes and units;
    /// from there it goes as rigidly as its source does (rig/head/sockets.h says which). Nothing: the face has no such
    /// part, or a node of it is flat. Needs no GL; allocates in the first call only.
    std::optional<DMat4> socket(Socket which) const;

    /// The surface at a point of this asset, as controls, nodes, joints, settings and place stand now, whatever was
    /// drawn last: what the GPU deforms, computed for the point's three corners alone. Pins are left out. A mesh that
    /// several nodes draw stands where the first of them does. Nothing: the point is of another asset, or was moved
    /// from. Needs no GL; allocates in the first call only.
    std::optional<SurfaceFrame> at(const SurfacePoint& point) const;

    /// Pins vertices of the surface to where the host says they are, after targets and joints: the border of a neck to
    /// that of a body (FaceAsset::neck_border()). What lies within `width_mm` millimetres of them at rest, along the
    /// surface, follows them, less with distance; what lies farther keeps its bits. `vertices`: one for each place; its
    /// copies across seams go with it. None: nothing is pinned any more. Nothing is pinned until move_pins(). Status: a
    /// vertex that does not exist, or a width that is negative or not finite.
    Status pin(std::span<const std::uint32_t> vertices, double width_mm);
    /// Where the pinned vertices are from now on: a position and a normal for each, in the file's space, like joints. A
    /// vertex whose position or normal is not finite, or whose normal has no length, is not pinned for that long.
    /// Status: another number than are pinned.
    Status move_pins(std::span<const Vec3> positions, std::span<const Vec3> normals);

    /// The deformed surface on the GPU, for a host that draws it itself: as the last draw or Scene::deform() left it.
    PublishedSurface surface() const;

    /// Status: no such effect, setting or choice, or one that another owner has (runtime/settings.h).
    Status set(std::string_view setting, std::string_view choice);

    CharacterState& state() { return *state_; }
    const CharacterState& state() const { return *state_; }
    const std::shared_ptr<CharacterState>& shared_state() const { return state_; }

private:
    explicit Character(std::shared_ptr<CharacterState> state);
    std::shared_ptr<CharacterState> state_;
};

}  // namespace blush
