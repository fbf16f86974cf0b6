#include "runtime/character.h"

#include <algorithm>
#include <cassert>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/files/face_file.h"
#include "runtime/files/occlusion_file.h"
#include "runtime/files/rig_description_file.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/state_guard.h"
#include "runtime/light/occlusion_gpu.h"

namespace blush {
namespace {

/// For each target, whether it moves a primitive for which `wanted(primitive)` holds.
template <class Wanted>
std::vector<std::uint8_t> targets_that_move(const Face& face, Wanted wanted) {
    std::vector<std::uint8_t> wanted_vertex(face.positions.size(), 0);
    for (const Primitive& primitive : face.primitives) {
        if (!wanted(primitive)) continue;
        std::fill_n(wanted_vertex.begin() + primitive.first_vertex, primitive.vertex_count, std::uint8_t{1});
    }
    std::vector<std::uint8_t> moves;
    moves.reserve(face.targets.size());
    for (const Target& target : face.targets) {
        moves.push_back(std::ranges::any_of(target.vertices, [&](std::uint32_t v) { return wanted_vertex[v] != 0; }));
    }
    return moves;
}

Status build_programs(CharacterState& state) {
    Result<gl::Program> tone = gl::make_program({"screen.vert", "camera/tone.frag"});
    if (!tone) return tone.error();
    state.tone_program = *std::move(tone);
    state.scene_framebuffer = gl::make_framebuffer();
    state.resolved_framebuffer = gl::make_framebuffer();
    state.output_framebuffer = gl::make_framebuffer();
    state.no_attributes = gl::make_vertex_array();
    return Done{};
}

}  // namespace

Character::Character(std::unique_ptr<CharacterState> state) : state_(std::move(state)) {}
Character::Character(Character&&) noexcept = default;
Character& Character::operator=(Character&&) noexcept = default;
Character::~Character() = default;

Result<Character> Character::load(const Device& device, const std::filesystem::path& path) {
    Result<Face> face = load_face(path);
    if (!face) return face.error();
    const Result<RigDescription> description = find_rig_description(*face);
    if (!description) return description.error();
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(path));
    if (!appearance) return appearance.error();
    Result<std::optional<OcclusionSet>> occlusion = find_occlusion(*face);
    if (!occlusion) return occlusion.error();
    Result<Character> character = create(device, *std::move(face), *description);
    if (character) {
        character->set_appearance(*std::move(appearance));
        character->set_occlusion(*std::move(occlusion));
    }
    return character;
}

Result<Character> Character::create(const Device& device, Face face, const std::optional<RigDescription>& description) {
    if (Status valid = validate(face); !valid) return valid.error();
    if (description) {
        if (Status good = check(*description, face); !good) {
            return Error{face.path + ": its rig description: " + good.error().message};
        }
    }
    Rig rig = description ? Rig(face, *description) : Rig(face);
    device.make_current();
    const gl::StateGuard guard;
    auto state = std::make_unique<CharacterState>(device, std::move(face), std::move(rig));
    Result<StreamOut> stream_out = StreamOut::create(device, state->face);
    if (!stream_out) return stream_out.error();
    state->stream_out.emplace(*std::move(stream_out));
    Result<FaceModel> model = FaceModel::create(state->face, device.info().largest_texture_side_texels);
    if (!model) return model.error();
    state->model = *std::move(model);
    if (Status programs = build_programs(*state); !programs) return programs.error();

    state->controls.assign(state->rig.control_names().size(), 0);
    state->pose = state->rig.rest_pose();
    state->head_and_eyes = find_head_and_eyes(state->face);
    state->bounds = moving_bounds(state->face);
    state->scale = face_scale(state->face);
    state->skin = find_skin(state->face);
    state->material_kind = material_kinds(state->face);
    state->eye_sockets = find_eye_sockets(state->face, state->material_kind);
    state->target_needs_turned_normals = targets_that_move(
        state->face, [](const Primitive& primitive) { return primitive.normal_source == NormalSource::recomputed; });
    state->target_moves_normals = targets_that_move(
        state->face, [](const Primitive& primitive) { return primitive.normal_source != NormalSource::rest; });
    state->world_from_node.resize(state->face.nodes.size());
    std::size_t joint_count = 0;
    for (const Skin& skin : state->face.skins) joint_count += skin.joints.size();
    state->skinned_from_mesh.resize(joint_count);
    return Character(std::move(state));
}

const Face& Character::face() const { return state_->face; }
const Rig& Character::rig() const { return state_->rig; }
std::optional<ControlId> Character::control(std::string_view name) const { return state_->rig.find(name); }

void Character::set(ControlId control, float value) {
    const auto index = static_cast<std::size_t>(control);
    assert(index < state_->controls.size() && "Character::set: a control of another rig");
    state_->controls[index] = value;
}

std::span<float> Character::controls() { return state_->controls; }
Pose& Character::pose() { return state_->pose; }
void Character::follow_blood(const BloodFlow* blood) { state_->blood = blood; }

Status Character::set(std::string_view setting, std::string_view choice) {
    return state_->settings.set(setting, choice);
}

void Character::set_appearance(FaceAppearance appearance) {
    state_->device.make_current();
    state_->appearance = std::move(appearance);
    state_->own<WrinkleTextures>() = {};
    state_->own<BloodTextures>() = {};
}

void Character::set_occlusion(std::optional<OcclusionSet> occlusion) {
    assert((!occlusion || std::ranges::all_of(occlusion->poses,
                                              [this](const OcclusionPose& pose) {
                                                  return pose.transfers.size() == face().positions.size();
                                              })) &&
           "Character::set_occlusion: coefficients of another face");
    state_->device.make_current();
    state_->occlusion = std::move(occlusion);
    state_->own<OcclusionBuffer>() = {};
}

OrbitCamera Character::framing(float aspect) const { return frame_head(state_->bounds, state_->scale, aspect); }

const FrameReport& Character::draw(const View& view) {
    if (view.width == 0 || view.height == 0) {
        state_->report = {};
        return state_->report;
    }
    state_->device.make_current();
    const gl::StateGuard guard;
    draw_frame(*state_, view);
    return state_->report;
}

Character::Surface Character::read_deformed() {
    state_->device.make_current();
    const gl::StateGuard guard;
    deform_only(*state_);
    const std::size_t count = state_->face.positions.size();
    Surface surface{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count), std::vector<glm::vec4>(count)};
    const auto read = [](const gl::Buffer& buffer, auto& out) {
        glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(out.size() * sizeof(out[0])), out.data());
    };
    const SurfaceBuffers& buffers = state_->morphed();
    read(buffers.positions, surface.positions);
    read(buffers.normals, surface.normals);
    read(buffers.tangents, surface.tangents);
    return surface;
}

}  // namespace blush
