#pragma once
/// Where a character stands: what its controls, nodes, joints and place make of it, without GL.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/deform/blend_shapes.h"
#include "rig/vectors.h"

namespace blush {

struct CharacterState;

/// All that decides where each point of the surface stands in the world.
struct Stance {
    std::vector<ActiveTarget> active;
    std::vector<DMat4> world_from_node;  ///< of each node and, last, of skinned vertices
    std::vector<Mat4> skinned_from_mesh;
    std::uint64_t pins = 0;  ///< another number whenever pins stand elsewhere; 0: nothing is pinned

    bool operator==(const Stance&) const = default;
};

/// `pose` has the weights, angles and nodes; `face_from_node` gets one matrix a node. Allocates nothing where the
/// vectors have their sizes.
void find_stance(const CharacterState& character, const Pose& pose, std::span<DMat4> face_from_node, Stance& stance);

/// The stance between frames, for questions that come then: of the controls as they are, whatever the last frame drew.
struct StanceNow {
    Pose pose;
    std::vector<DMat4> face_from_node;
    Stance stance;

    // What it was made from.
    bool valid = false;
    std::vector<float> controls;
    std::vector<Mat4> host_joints;
    DMat4 world_from_face{1};
};

/// Brings it up to date. Allocates in the first call only.
const StanceNow& stance_now(CharacterState& character);

}  // namespace blush
