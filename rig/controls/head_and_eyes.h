#pragma once
/// Which nodes of a face the head's and the eyes' angles turn, and where every node stands in the world.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// A node that angles turn about a point.
struct Pivot {
    std::int32_t node = -1;  ///< -1: the face has none
    Vec3 point_node{0};      ///< in the node's own space, at rest
};

struct HeadAndEyes {
    Pivot head;  ///< the lowest node that holds every mesh; turns about the base of the skull, where it can be told
    Pivot left_eye, right_eye;
};

/// Finds them by the nodes' names ("eyeLeft", "Eye_L", "grp_eyeRight", ...). An eye turns about its node's origin where
/// that lies inside the eye's bounds, else about their centre. Of two eyes, the left one is that on the face's own left
/// (+X): some files name their nodes as the viewer sees them and their targets as the face does. The head turns
/// about the point in the middle of its bounds from side to side and a third of the way up (where the neck carries a
/// head that is modelled down to its neck).
HeadAndEyes find_head_and_eyes(const Face& face);

/// face_from_node of every node, parents first: from a node's space to that of the face's file. Composed in double
/// precision, so that a file whose nodes stand far out places its parts beside one another. `placed` has one entry a
/// node. No allocation.
void place_nodes(const Face& face, const Pose& pose, const HeadAndEyes& pivots, std::span<DMat4> placed);

/// skinned_from_mesh of every joint of every skin, skins one after the other, for StreamOut::skin and skin(): the
/// mesh node's own place cancels (glTF 2.0, 3.7.3.3), so skinned vertices are in the face's space, here less `origin`
/// (where the face stands in its file), so that their floats are fine.
void skinned_from_meshes(const Face& face, std::span<const DMat4> placed, DVec3 origin, std::span<Mat4> joints);

/// The same of the face at rest, without angles.
std::vector<DMat4> rest_placement(const Face& face);

struct Bounds {
    Vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
    bool empty() const { return !(low.x <= high.x); }
    Vec3 centre() const { return 0.5F * low + 0.5F * high; }
    Vec3 size() const { return high - low; }
    void add(Vec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Bounds in the world of everything that the nodes draw, at rest and with each target alone at weight 1: where the
/// face can be expected to go.
Bounds moving_bounds(const Face& face);

}  // namespace blush
