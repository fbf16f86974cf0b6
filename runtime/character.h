#pragma once
/// Character: a face on a device, with controls to set and a frame to draw.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "rig/controls/rig.h"
#include "rig/face.h"
#include "rig/light/occlusion.h"
#include "rig/motion/blood_flow.h"
#include "rig/result.h"
#include "runtime/camera.h"
#include "runtime/device.h"
#include "runtime/files/face_appearance.h"
#include "runtime/frame_report.h"
#include "runtime/settings.h"
#include "runtime/view.h"

namespace blush {

struct CharacterState;

class Character {
public:
    /// Loads a face file (runtime/files/face_file.h) onto the device, with the rig description beside it where there is
    /// one (runtime/files/rig_description_file.h).
    static Result<Character> load(const Device& device, const std::filesystem::path& path);
    /// The same from a face in memory, which must satisfy validate(), and a description, which must satisfy check();
    /// without one, that of its target names.
    static Result<Character> create(const Device& device, Face face,
                                    const std::optional<RigDescription>& description = std::nullopt);

    Character(Character&&) noexcept;
    Character& operator=(Character&&) noexcept;
    ~Character();

    const Face& face() const;
    const Rig& rig() const;

    /// A control by its name or any of its usual spellings; resolve once, then set by id.
    std::optional<ControlId> control(std::string_view name) const;
    /// A value that is not finite counts as 0.
    void set(ControlId control, float value);
    /// All controls of the rig at once, to be written in place (for BoundPerformance::sample).
    std::span<float> controls();
    /// The pose that node animations write to; its weights and angles come from the controls at the next draw.
    Pose& pose();

    /// Lets slow blood (rig/motion/blood_flow.h) say where the blood is instead of the pose; null: the pose again. It
    /// must outlive its use here.
    void follow_blood(const BloodFlow* blood);

    /// Status: no such effect, setting or choice.
    Status set(std::string_view setting, std::string_view choice);

    /// The maps of its wrinkles and its blood. load() finds them beside the file (runtime/files/face_appearance.h).
    void set_appearance(FaceAppearance appearance);
    /// How the face hides ambient light from itself: one transfer a vertex of this face in each pose; nothing: it hides
    /// none. load() finds the file beside the face's (runtime/files/occlusion_file.h).
    void set_occlusion(std::optional<OcclusionSet> occlusion);

    /// A camera that frames the head at rest, and of a bust what lies close to it. aspect: width / height.
    OrbitCamera framing(float aspect) const;

    /// Draws one frame into view.framebuffer and restores every GL state that it touched. The report stands until the
    /// next draw. A view without pixels draws nothing.
    const FrameReport& draw(const View& view);

    /// Deforms (on the GPU, without drawing) and reads back: mesh-local positions, normals, tangents of every vertex.
    struct Surface {
        std::vector<Vec3> positions, normals;
        std::vector<Vec4> tangents;
    };
    Surface read_deformed();

    CharacterState& state() { return *state_; }

private:
    explicit Character(std::unique_ptr<CharacterState> state);
    std::unique_ptr<CharacterState> state_;
};

}  // namespace blush
