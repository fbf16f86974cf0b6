#include "runtime/face_asset.h"

#include <algorithm>
#include <cassert>

#include "rig/far_vertices.h"
#include "runtime/files/face_file.h"
#include "runtime/files/occlusion_file.h"
#include "runtime/files/rig_description_file.h"
#include "runtime/frame/asset_state.h"

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

bool fits(const std::optional<OcclusionSet>& occlusion, const Face& face) {
    return !occlusion || std::ranges::all_of(occlusion->poses, [&face](const OcclusionPose& pose) {
        return pose.transfers.size() == face.positions.size();
    });
}

}  // namespace

AssetState::AssetState(Face loaded, Rig its) : face(std::move(loaded)), rig(std::move(its)) {
    head_and_eyes = find_head_and_eyes(face);
    bounds = moving_bounds(face);
    scale = face_scale(face);
    skin = find_skin(face);
    extents = find_extents(face);
    material_kind = material_kinds(face);
    eye_sockets = find_eye_sockets(face, material_kind);
    target_needs_turned_normals = targets_that_move(
        face, [](const Primitive& primitive) { return primitive.normal_source == NormalSource::recomputed; });
    target_moves_normals = targets_that_move(
        face, [](const Primitive& primitive) { return primitive.normal_source != NormalSource::rest; });
    for (const Skin& part : face.skins) joint_count += part.joints.size();
    has_triangles =
        std::ranges::any_of(face.primitives, [](const Primitive& primitive) { return primitive.index_count >= 3; });
    if (!bounds.empty()) skinned_origin = glm::dvec3(bounds.centre());
    rest_placement = blush::rest_placement(face);
    std::vector<glm::mat4> joints(joint_count);
    skinned_from_meshes(face, rest_placement, skinned_origin, joints);
    // One by one: a copy of the library's between two types of GLM would be shared with the host.
    for (const glm::mat4& joint : joints) rest_skinned_from_mesh.emplace_back(joint);
    sockets = find_sockets(face, head_and_eyes, eye_sockets, material_kind);
}

FaceAsset::FaceAsset(std::shared_ptr<const AssetState> state) : state_(std::move(state)) {}

Result<FaceAsset> FaceAsset::load(const std::filesystem::path& path) {
    Result<Face> face = load_face(path);
    if (!face) return face.error();
    const Result<RigDescription> description = find_rig_description(*face);
    if (!description) return description.error();
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(path));
    if (!appearance) return appearance.error();
    Result<std::optional<OcclusionSet>> occlusion = find_occlusion(*face);
    if (!occlusion) return occlusion.error();
    return create(*std::move(face), *description, *std::move(appearance), *std::move(occlusion));
}

Result<FaceAsset> FaceAsset::create(Face face, const std::optional<RigDescription>& description,
                                    FaceAppearance appearance, std::optional<OcclusionSet> occlusion) {
    if (Status valid = validate(face); !valid) return valid.error();
    if (description) {
        if (Status good = check(*description, face); !good) {
            return Error{face.path + ": its rig description: " + good.error().message};
        }
    }
    if (!fits(occlusion, face)) {
        return Error{face.path + ": its occlusion is of another face, with another number of vertices"};
    }
    const double step = float_step(face);
    const Recentred recentred = recentre(face);
    Rig rig = description ? Rig(face, *description) : Rig(face);
    auto state = std::make_shared<AssetState>(std::move(face), std::move(rig));
    state->appearance = std::move(appearance);
    state->occlusion = std::move(occlusion);
    state->float_step_mm = step * state->scale.millimetres_a_unit;
    state->mesh_origin = recentred.mesh_origin;
    for (std::size_t s = 0; s < recentred.skin_origin.size(); ++s) {
        const std::size_t joints = state->face.skins[s].joints.size();
        state->joint_mesh_origin.insert(state->joint_mesh_origin.end(), joints, glm::dvec3(recentred.skin_origin[s]));
    }
    return FaceAsset(std::move(state));
}

FaceAsset FaceAsset::with_appearance(FaceAppearance appearance) const {
    auto state = std::make_shared<AssetState>(*state_);
    state->appearance = std::move(appearance);
    return FaceAsset(std::move(state));
}

FaceAsset FaceAsset::with_occlusion(std::optional<OcclusionSet> occlusion) const {
    assert(fits(occlusion, face()) && "FaceAsset::with_occlusion: coefficients of another face");
    auto state = std::make_shared<AssetState>(*state_);
    state->occlusion = std::move(occlusion);
    return FaceAsset(std::move(state));
}

const Face& FaceAsset::face() const { return state_->face; }
const Rig& FaceAsset::rig() const { return state_->rig; }
const FaceAppearance& FaceAsset::appearance() const { return state_->appearance; }
double FaceAsset::float_step_mm() const { return state_->float_step_mm; }
OrbitCamera FaceAsset::framing(float aspect) const { return frame_head(state_->bounds, state_->scale, aspect); }

}  // namespace blush
