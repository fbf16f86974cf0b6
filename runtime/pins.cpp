/// Pins of a character: FaceAsset::neck_border(), Character::pin(), Character::move_pins().

#include <algorithm>
#include <cmath>

#include "rig/deform/face_part.h"
#include "rig/deform/open_borders.h"
#include "rig/deform/rest_places.h"
#include "runtime/character.h"
#include "runtime/deform/pinned_surface.h"
#include "runtime/frame/character_state.h"

namespace blush {

std::vector<std::uint32_t> FaceAsset::neck_border() const {
    const AssetState& asset = *state_;
    std::vector<std::uint8_t> drawn, skin;
    for (const Primitive& primitive : asset.face.primitives) {
        const std::size_t material =
            primitive.material < 0 ? asset.face.materials.size() : static_cast<std::size_t>(primitive.material);
        drawn.push_back(drawing_node(asset.face, primitive.mesh) >= 0 ? 1 : 0);
        skin.push_back(drawn.back() != 0 && asset.material_kind[material] == MaterialKind::skin ? 1 : 0);
    }
    const bool has_skin = std::ranges::find(skin, std::uint8_t{1}) != skin.end();
    const std::vector<glm::dvec3> places = rest_places(asset.face, asset.skinned_origin);
    return blush::neck_border(asset.face, has_skin ? skin : drawn, places);
}

Status Character::pin(std::span<const std::uint32_t> vertices, double width_mm) {
    const AssetState& asset = state_->facts_of_face;
    const Face& its = asset.face;
    if (!std::isfinite(width_mm) || width_mm < 0) {
        return Error{its.path + ": the width of pinning is " + std::to_string(width_mm) +
                     " mm; it must be finite and not below 0"};
    }
    auto pinned = std::make_shared<PinnedSurface>();
    for (const std::uint32_t vertex : vertices) {
        const auto primitive = std::ranges::find_if(its.primitives, [vertex](const Primitive& each) {
            return vertex >= each.first_vertex && vertex - each.first_vertex < each.vertex_count;
        });
        if (primitive == its.primitives.end() || drawing_node(its, primitive->mesh) < 0) {
            return Error{its.path + ": vertex " + std::to_string(vertex) + " cannot be pinned: no node draws it"};
        }
        const auto node = static_cast<std::size_t>(drawing_node(its, primitive->mesh));
        pinned->entry.push_back(its.nodes[node].skin >= 0 && !its.joints.empty() ? its.nodes.size() : node);
    }
    // The old buffers go in their own context, and what was published of them with them.
    state_->device.make_current();
    if (state_->pinned && state_->surface == &state_->pinned->surface) state_->surface = nullptr;
    if (state_->pinned) pinned->number = state_->pinned->number;  // further pins must not pass for these
    pinned->vertices.assign(vertices.begin(), vertices.end());
    pinned->pins.resize(vertices.size());
    pinned->ring =
        pin_ring(its, rest_places(its, asset.skinned_origin), vertices, width_mm / asset.scale.millimetres_a_unit);
    state_->pinned = std::move(pinned);
    return Done{};
}

Status Character::move_pins(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals) {
    const std::size_t wanted = state_->pinned ? state_->pinned->vertices.size() : 0;
    if (positions.size() != wanted || normals.size() != wanted) {
        return Error{face().path + ": " + std::to_string(positions.size()) + " positions and " +
                     std::to_string(normals.size()) + " normals given for pins; " + std::to_string(wanted) +
                     " vertices are pinned"};
    }
    if (wanted == 0) return Done{};
    state_->pinned->positions_face.assign(positions.begin(), positions.end());
    state_->pinned->normals_face.assign(normals.begin(), normals.end());
    return Done{};
}

}  // namespace blush
