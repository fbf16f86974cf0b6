/// Sockets of a character: Character::socket().

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/deform/face_part.h"
#include "rig/head/rigid_fit.h"
#include "rig/head/sockets.h"
#include "runtime/character.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/stand.h"

namespace blush {
namespace {

/// What the sockets of one character keep between questions.
struct SocketPatches {
    struct Patch {
        Patch(const Face& face, const SocketSource& source)
            : part(face, source.vertices, FacePart::Wanted::positions),
              now(source.vertices.size()),
              rest(source.vertices.size()) {}
        FacePart part;
        std::vector<std::size_t> entry;  ///< of each vertex: the node that draws it, or one past the last where skinned
        std::vector<glm::dvec3> now, rest;  ///< in the file's space
        glm::dvec3 middle{0};               ///< at rest
    };
    std::array<std::unique_ptr<Patch>, socket_count> made;
};

void find_points(const AssetState& asset, SocketPatches::Patch& patch, std::span<const float> weights,
                 std::span<const glm::dmat4> face_from_node, std::span<const glm::mat4> joints,
                 std::vector<glm::dvec3>& points) {
    patch.part.deform(weights, NormalMethod::authored, joints);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 position(patch.part.position(i));
        points[i] = patch.entry[i] == face_from_node.size()
                        ? position + asset.skinned_origin
                        : glm::dvec3(face_from_node[patch.entry[i]] * glm::dvec4(position, 1));
    }
}

std::unique_ptr<SocketPatches::Patch> make_patch(const CharacterState& character, const SocketSource& source) {
    const AssetState& asset = character.facts_of_face;
    const Face& face = asset.face;
    auto patch = std::make_unique<SocketPatches::Patch>(face, source);
    for (const std::uint32_t v : source.vertices) {
        const auto primitive = std::ranges::find_if(face.primitives, [v](const Primitive& each) {
            return v >= each.first_vertex && v - each.first_vertex < each.vertex_count;
        });
        const auto node = static_cast<std::size_t>(drawing_node(face, primitive->mesh));
        patch->entry.push_back(face.nodes[node].skin >= 0 && !face.joints.empty() ? face.nodes.size() : node);
    }
    const Pose rest = character.rig.rest_pose();
    const std::vector<glm::dmat4> placed = rest_placement(face);
    std::vector<glm::mat4> joints(asset.joint_count);
    skinned_from_meshes(face, placed, asset.skinned_origin, joints);
    find_points(asset, *patch, rest.weights, placed, joints, patch->rest);
    double sum = 0;
    for (std::size_t i = 0; i < patch->rest.size(); ++i) {
        patch->middle += source.weights[i] * patch->rest[i];
        sum += source.weights[i];
    }
    patch->middle /= sum;
    return patch;
}

/// In the file's space, from where it is at rest.
glm::dmat4 motion_of_node(const CharacterState& character, const StanceNow& now, const SocketSource& source) {
    const AssetState& asset = character.facts_of_face;
    const auto node = static_cast<std::size_t>(source.node);
    if (source.joint < 0 || character.host_joints.empty()) {
        return now.face_from_node[node] * glm::inverse(asset.rest_placement[node]);
    }
    // The host's skeleton says where the joint is.
    const auto joint = static_cast<std::size_t>(source.joint);
    const glm::dmat4 to_file = glm::translate(glm::dmat4(1), asset.skinned_origin);
    return to_file * glm::dmat4(now.stance.skinned_from_mesh[joint]) *
           glm::inverse(to_file * asset.rest_skinned_from_mesh[joint]);
}

bool finite(const glm::dmat4& matrix) {
    for (glm::length_t c = 0; c < 4; ++c) {
        for (glm::length_t r = 0; r < 4; ++r) {
            if (!std::isfinite(matrix[c][r])) return false;
        }
    }
    return true;
}

}  // namespace

std::optional<glm::dmat4> Character::socket(Socket which) const {
    const auto index = static_cast<std::size_t>(which);
    if (index >= socket_count) return std::nullopt;
    const SocketSource& source = state_->facts_of_face.sockets[index];
    if (source.kind == SocketSource::Kind::none) return std::nullopt;
    const StanceNow& now = stance_now(*state_);
    glm::dmat4 motion(1);
    glm::dvec3 origin = source.origin_face;
    if (source.kind == SocketSource::Kind::node) {
        motion = motion_of_node(*state_, now, source);
    } else {
        std::unique_ptr<SocketPatches::Patch>& patch = state_->own<SocketPatches>().made[index];
        if (!patch) patch = make_patch(*state_, source);
        find_points(state_->facts_of_face, *patch, now.pose.weights, now.face_from_node, now.stance.skinned_from_mesh,
                    patch->now);
        motion = fit_rigid(patch->rest, patch->now, source.weights);
        origin = patch->middle;
    }
    const glm::dmat4 world = state_->world_from_face * motion * glm::translate(glm::dmat4(1), origin);
    return finite(world) ? std::optional(world) : std::nullopt;
}

}  // namespace blush
