#pragma once
/// Rig: named controls in, one Pose out (jimenez-2012, 7.5 and 8.2: geometry, wrinkles and colour read one rig).

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/control_table.h"
#include "rig/controls/rig_description.h"
#include "rig/controls/rig_program.h"
#include "rig/face.h"
#include "rig/names.h"

namespace blush {

/// Index of a control, resolved once by name.
enum class ControlId : std::uint32_t {};

/// Angles of the head or of one eye, as Live Link Face records them.
struct Angles {
    float yaw_radians =
        0;  ///< about world +Y; positive turns to the face's own left (+X for a glTF face, which looks along +Z)
    float pitch_radians = 0;  ///< about world +X; positive looks down
    float roll_radians = 0;   ///< about world +Z; positive tilts the top of the head to the face's own right (-X)
};

/// Everything that a frame needs to know of what the face does. Geometry, wrinkles and colour read this alone.
struct Pose {
    std::vector<float> weights;    ///< one for each of Face::targets, finite
    std::vector<Transform> nodes;  ///< parent_from_node of each of Face::nodes (ignored where the node has a matrix)
    Angles head, left_eye, right_eye;
    std::vector<float> wrinkles;    ///< one for each wrinkle zone, clamped to the zone's range (jimenez-2012, 8.2)
    std::vector<float> hemoglobin;  ///< share of each expression's and state's map, 0 or more; the neutral map has the
                                    ///< rest, so that all add up to 1 (jimenez-2012, 7.5)
    float hemoglobin_factor = 1;    ///< on the hemoglobin of the whole face

    std::vector<float> acting;   ///< one for each control: its value with what drives it, limited
    std::vector<float> scratch;  ///< evaluate()'s own; what is in it before does not count
};

/// How the controls of a face become its Pose. Immutable after construction; evaluate() may run on any thread.
///
/// Controls, in this order: the face's targets by their own names; headYaw, headPitch, headRoll, leftEyeYaw,
/// leftEyePitch, leftEyeRoll, rightEyeYaw, rightEyePitch, rightEyeRoll (radians); those of ARKit's names that the face
/// has in another form; action units, emotions, compounds, states.
class Rig {
public:
    /// With the description that the face's target names give.
    explicit Rig(const Face& face);
    /// The description satisfies check(description, face).
    Rig(const Face& face, const RigDescription& description);

    std::span<const std::string> control_names() const { return table_.names; }
    const ControlInfo& info(ControlId control) const { return table_.infos[static_cast<std::size_t>(control)]; }
    std::size_t target_count() const { return table_.target_count; }
    /// Names of Pose::wrinkles and of Pose::hemoglobin, in order.
    std::span<const std::string> wrinkle_zones() const { return zone_names_; }
    std::span<const std::string> hemoglobin_maps() const { return map_names_; }

    /// By exact name, else by any of the usual spellings (rig/names.h).
    std::optional<ControlId> find(std::string_view name) const;
    /// Whether the control is of that kind, or a target that takes the place of an expression of that kind.
    bool is(ControlId control, ControlKind kind) const;
    /// What the control drives by itself.
    std::span<const RigProgram::Link> drives(ControlId control) const;
    /// Every target that the control moves, by itself or through others; for a target, itself too. Ascending.
    std::vector<std::uint32_t> reach(ControlId control) const;

    /// Those of ARKit's 52 that the face has in no form.
    std::span<const std::string> unmatched_arkit() const { return unmatched_arkit_; }
    /// What expressions would drive, had the face a shape for it: "AU13: cheekPuffLeft", one entry an expression.
    std::span<const std::string> unmatched_drives() const { return program_.unmatched_drives; }

    /// Correctives, in-betweens and zones by index.
    const RigProgram& program() const { return program_; }
    /// What a corrective adds to its target in an evaluated pose.
    float value_of(const RigProgram::Corrective& corrective, const Pose& pose) const {
        return corrective_value(corrective, pose.acting);
    }

    /// A pose of the right sizes: zero weights, nodes at rest. Allocates; evaluate() then does not.
    Pose rest_pose() const;

    /// controls: one value for each control. A value that is not finite, or subnormal, counts as 0 (rule: the face
    /// rests rather than breaks); a weight beyond +-largest_weight counts as that; action units, emotions, compounds
    /// and states are held to 0..1. Every output is a continuous function of the controls. Writes all of `pose` but its
    /// nodes. No allocation, no hidden state.
    void evaluate(std::span<const float> controls, Pose& pose) const;

private:
    float corrective_value(const RigProgram::Corrective& corrective, std::span<const float> acting) const;
    void copy_own(std::span<const float> controls, std::span<float> acting) const;
    void drive(Pose& pose) const;
    void write_weights(Pose& pose) const;
    void write_angles(Pose& pose) const;
    void write_wrinkles(Pose& pose) const;
    void write_hemoglobin(Pose& pose) const;

    ControlTable table_;
    RigProgram program_;
    std::vector<ControlKind> kind_in_library_;  ///< of each control: that of the expression whose place a target takes
    std::vector<std::string> zone_names_, map_names_, unmatched_arkit_;
    std::vector<Transform> node_rest_;
};

}  // namespace blush
