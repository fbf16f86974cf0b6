#include "runtime/character.h"

#include <algorithm>
#include <cmath>

#include "runtime/frame/character_state.h"
#include "runtime/frame/device_state.h"
#include "runtime/gl/state_guard.h"

namespace blush {
namespace {

/// The model of an asset on a device: of a character that is there already, or made.
Result<std::shared_ptr<FaceModel>> model_of(const Device& device, const FaceAsset& asset) {
    std::map<const AssetState*, std::weak_ptr<FaceModel>>& models = device.state().models;
    std::erase_if(models, [](const auto& entry) { return entry.second.expired(); });
    if (std::shared_ptr<FaceModel> made = models[&asset.state()].lock()) return made;
    Result<std::shared_ptr<FaceModel>> model = FaceModel::create(device, asset);
    if (model) models[&asset.state()] = *model;
    return model;
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

CharacterState::CharacterState(Device on, FaceAsset shows, std::shared_ptr<FaceModel> its)
    : device(std::move(on)),
      asset(std::move(shows)),
      facts_of_face(asset.state()),
      face(facts_of_face.face),
      rig(facts_of_face.rig),
      model(std::move(its)),
      stream_out(model->deform) {
    controls.assign(rig.control_names().size(), 0);
    pose = rig.rest_pose();
    const std::size_t nodes = face.nodes.size();
    face_from_node.resize(nodes);
    stance.world_from_node.resize(nodes + 1);
    stance.skinned_from_mesh.resize(facts_of_face.joint_count);
    shading_from_node.resize(nodes + 1);
    draw_blocks = DrawBlocks::create(nodes + 1);
    frame_block = gl::make_buffer(sizeof(shared::FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

Character::Character(std::shared_ptr<CharacterState> state) : state_(std::move(state)) {}

Result<Character> Character::create(const Device& device, const FaceAsset& asset) {
    device.make_current();
    const gl::StateGuard guard;
    Result<std::shared_ptr<FaceModel>> model = model_of(device, asset);
    if (!model) return model.error();
    return Character(on_device(new CharacterState(device, asset, *std::move(model))));
}

const FaceAsset& Character::asset() const { return state_->asset; }

void Character::set(ControlId control, float value) {
    const auto index = static_cast<std::size_t>(control);
    if (index < state_->controls.size()) state_->controls[index] = value;
}

std::span<float> Character::controls() { return state_->controls; }
Pose& Character::pose() { return state_->pose; }
void Character::follow_blood(const BloodFlow* blood) { state_->blood = blood; }
void Character::place(const glm::dmat4& world_from_face) {
    state_->world_from_face = finite(world_from_face) ? world_from_face : glm::dmat4(1);
}
const glm::dmat4& Character::placed() const { return state_->world_from_face; }

Status Character::set_joints(std::span<const glm::mat4> skinned_from_mesh) {
    const std::size_t wanted = state_->facts_of_face.joint_count;
    if (!skinned_from_mesh.empty() && skinned_from_mesh.size() != wanted) {
        return Error{face().path + ": " + std::to_string(skinned_from_mesh.size()) + " joints given; the face has " +
                     std::to_string(wanted)};
    }
    state_->host_joints.assign(skinned_from_mesh.begin(), skinned_from_mesh.end());
    return Done{};
}

Status Character::set(std::string_view setting, std::string_view choice) {
    return state_->settings.set(setting, choice, SettingOwner::character);
}

}  // namespace blush
