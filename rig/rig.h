#pragma once
/// Rig: named controls in, one Pose out (jimenez-2012, 7.5 and 8.2: geometry, wrinkles and colour read one rig).

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
};

/// Weights are limited to this on either side: far beyond any use, and small enough that no sum overflows.
inline constexpr float largest_weight = 1000;

/// How the controls of a face become its Pose. Immutable after construction; evaluate() may run on any thread.
///
/// Controls, in this order: the face's targets by their own names, then headYaw, headPitch, headRoll, leftEyeYaw,
/// leftEyePitch, leftEyeRoll, rightEyeYaw, rightEyePitch, rightEyeRoll (radians).
class Rig {
public:
    explicit Rig(const Face& face);

    std::span<const std::string> control_names() const { return names_; }
    std::size_t target_count() const { return target_count_; }

    /// By exact name, else by any of the usual spellings (rig/names.h).
    std::optional<ControlId> find(std::string_view name) const;

    /// A pose of the right sizes: zero weights, nodes at rest. Allocates; evaluate() then does not.
    Pose rest_pose() const;

    /// controls: one value for each control. A value that is not finite counts as 0 (rule: the face rests rather than
    /// breaks); a weight beyond +-largest_weight counts as that. Writes weights and angles of `pose`, leaves its nodes
    /// as they are. No allocation, no hidden state.
    void evaluate(std::span<const float> controls, Pose& pose) const;

private:
    std::vector<std::string> names_;
    NameIndex index_;
    std::vector<Transform> node_rest_;
    std::size_t target_count_ = 0;
};

}  // namespace blush
