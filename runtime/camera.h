#pragma once
/// A camera that orbits, and finds its own place in front of a head.

#include "rig/controls/head_and_eyes.h"
#include "rig/head/face_scale.h"
#include "rig/vectors.h"
#include "runtime/view.h"

namespace blush {

struct OrbitCamera {
    DVec3 target_world{0};
    float distance = 1;       ///< above 0, world units
    float yaw_radians = 0;    ///< 0 looks at the front of a glTF face; positive moves the camera to the face's left
    float pitch_radians = 0;  ///< positive moves the camera up; clamped to +-1.5 (the poles have no up)
    /// 24 degrees: a portrait lens (about 85 mm on a 35 mm frame), which keeps the nose from growing.
    float vertical_field_of_view_radians = 0.42F;
    float scene_radius = 1;  ///< world units; places the near and far planes

    /// aspect: width / height.
    Camera camera(float aspect) const;
};

/// What a portrait shows of `bounds`: the uppermost 270 mm, 250 mm wide about the middle. A head with its hair and the
/// neck is within (head height 225 mm in the mean: Farkas 1994); shoulders and chest of a bust are not.
/// A face whose scale is a guess from `bounds` is shown whole.
Bounds portrait(const Bounds& bounds, const FaceScale& scale);

/// Frames the portrait of `bounds` from the front with a margin. Empty or non-finite bounds give a camera that looks at
/// the origin.
OrbitCamera frame_head(const Bounds& bounds, const FaceScale& scale, float aspect);

}  // namespace blush
