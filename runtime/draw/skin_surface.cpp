#include "runtime/draw/skin_surface.h"

#include <algorithm>
#include <cmath>

#include "rig/head/skin_material.h"
#include "runtime/frame/clip_bounds.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/scatter_projection.h"

namespace blush {
namespace {

float largest_scale(const glm::mat4& matrix) {
    return std::max(
        {glm::length(glm::vec3(matrix[0])), glm::length(glm::vec3(matrix[1])), glm::length(glm::vec3(matrix[2]))});
}

}  // namespace

SkinSurface find_skin(const Face& face) {
    SkinSurface skin;
    skin.material = skin_materials(face);
    std::vector<std::uint8_t> is_skin(face.positions.size(), 0);
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            const std::size_t material =
                primitive.material < 0 ? face.materials.size() : static_cast<std::size_t>(primitive.material);
            if (!skin.material[material] || primitive.vertex_count == 0) continue;
            Bounds bounds;
            for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
                bounds.add(face.positions[primitive.first_vertex + v]);
            }
            std::fill_n(is_skin.begin() + primitive.first_vertex, primitive.vertex_count, std::uint8_t{1});
            skin.parts.push_back({n, bounds});
        }
    }
    for (const Target& target : face.targets) {
        float reach = 0;
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            if (is_skin[target.vertices[i]] != 0) reach = std::max(reach, glm::length(target.position_deltas[i]));
        }
        skin.target_reach.push_back(reach);
    }
    return skin;
}

SkinOnScreen place_skin(const FrameState& frame, const CharacterState& character) {
    const SkinSurface& skin = character.facts_of_face.skin;
    SkinOnScreen result;
    float reach = 0;
    for (const ActiveTarget& entry : character.active()) {
        reach += std::abs(entry.weight) * skin.target_reach[entry.target];
    }
    const ScatterProjection projection = scatter_projection(frame, character.millimetres_a_unit);
    for (const SkinSurface::Part& part : skin.parts) {
        const glm::mat4 view = character.view_from_shading * character.shading_from_node[part.node];
        Bounds bounds = part.bounds;
        bounds.low -= reach;
        bounds.high += reach;
        // Joints and pins move a surface anywhere; then, and where a number is not finite, it may be seen, and be near.
        const bool known = !character.facts.has_joints && !character.facts.pinned && std::isfinite(reach) &&
                           std::isfinite(largest_scale(view));
        if (known && outside_view(clip_corners(frame.clip_from_view * view, bounds))) continue;
        result.on_screen = true;
        double nearest = 0;
        if (known) {
            nearest = std::numeric_limits<double>::max();
            for (const glm::vec4& corner : clip_corners(view, bounds)) {
                nearest = std::min(nearest, static_cast<double>(-corner.z) * character.millimetres_a_unit);
            }
        }
        const glm::dvec2 pixels = projection.pixels_a_mm(std::max(nearest, 0.0));
        result.pixels_a_mm = std::max({result.pixels_a_mm, pixels.x, pixels.y});
    }
    return result;
}

}  // namespace blush
