#include "runtime/frame/stand.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/character_state.h"

namespace blush {
namespace {

bool same(const std::vector<Transform>& a, const std::vector<Transform>& b) {
    return std::ranges::equal(a, b, [](const Transform& x, const Transform& y) {
        return x.translation == y.translation && x.rotation == y.rotation && x.scale == y.scale;
    });
}

}  // namespace

void find_stance(const CharacterState& character, const Pose& pose, std::span<glm::dmat4> face_from_node,
                 Stance& stance) {
    const AssetState& asset = character.facts_of_face;
    find_active(pose.weights, stance.active);
    place_nodes(character.face, pose, asset.head_and_eyes, face_from_node);
    for (std::size_t n = 0; n < face_from_node.size(); ++n) {
        stance.world_from_node[n] = character.world_from_face * face_from_node[n];
    }
    stance.world_from_node.back() = character.world_from_face * glm::translate(glm::dmat4(1), asset.skinned_origin);
    if (character.host_joints.empty()) {
        skinned_from_meshes(character.face, face_from_node, asset.skinned_origin, stance.skinned_from_mesh);
        return;
    }
    for (std::size_t j = 0; j < stance.skinned_from_mesh.size(); ++j) {
        // From the file's own vertices, which stand mesh_origin off ours, to the file's space less skinned_origin.
        glm::dmat4 joint(character.host_joints[j]);
        joint[3] = joint * glm::dvec4(asset.joint_mesh_origin[j], 1);
        joint[3] -= glm::dvec4(asset.skinned_origin, 0);
        stance.skinned_from_mesh[j] = glm::mat4(joint);
    }
}

const StanceNow& stance_now(CharacterState& character) {
    StanceNow& now = character.own<StanceNow>();
    const bool same_as_before =
        now.valid && now.controls == character.controls && same(now.pose.nodes, character.pose.nodes) &&
        now.host_joints == character.host_joints && now.world_from_face == character.world_from_face;
    if (same_as_before) return now;
    if (!now.valid) {
        now.pose = character.rig.rest_pose();
        now.face_from_node.resize(character.face_from_node.size());
        now.stance.world_from_node.resize(character.stance.world_from_node.size());
        now.stance.skinned_from_mesh.resize(character.stance.skinned_from_mesh.size());
        now.stance.active.reserve(character.face.targets.size());
        now.host_joints.reserve(character.stance.skinned_from_mesh.size());
        now.valid = true;
    }
    now.controls = character.controls;
    now.pose.nodes = character.pose.nodes;
    now.host_joints = character.host_joints;
    now.world_from_face = character.world_from_face;
    character.rig.evaluate(now.controls, now.pose);
    find_stance(character, now.pose, now.face_from_node, now.stance);
    return now;
}

}  // namespace blush
