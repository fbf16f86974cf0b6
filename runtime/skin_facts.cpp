#include "runtime/skin_facts.h"

#include <algorithm>
#include <cmath>

#include "rig/skin_material.h"
#include "runtime/clip_bounds.h"
#include "runtime/effect.h"
#include "runtime/effects/scattering.h"

namespace blush {
namespace {

float largest_scale(const glm::mat4& matrix) {
    return std::max(
        {glm::length(glm::vec3(matrix[0])), glm::length(glm::vec3(matrix[1])), glm::length(glm::vec3(matrix[2]))});
}

}  // namespace

void find_skin_parts(CharacterState& state) {
    const Face& face = state.face;
    state.skin_material = skin_materials(face);
    state.material_kind = material_kinds(face);
    std::vector<std::uint8_t> is_skin(face.positions.size(), 0);
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            const std::size_t material =
                primitive.material < 0 ? face.materials.size() : static_cast<std::size_t>(primitive.material);
            if (!state.skin_material[material] || primitive.vertex_count == 0) continue;
            Bounds bounds;
            for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
                bounds.add(face.positions[primitive.first_vertex + v]);
            }
            std::fill_n(is_skin.begin() + primitive.first_vertex, primitive.vertex_count, std::uint8_t{1});
            state.skin_parts.push_back({n, bounds});
        }
    }
    for (const Target& target : face.targets) {
        float reach = 0;
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            if (is_skin[target.vertices[i]] != 0) reach = std::max(reach, glm::length(target.position_deltas[i]));
        }
        state.target_reach.push_back(reach);
    }
}

void find_skin_facts(CharacterState& state) {
    const double set_scale = state.settings.number(scattering_effect.name, "millimetres_a_unit");
    state.millimetres_a_unit = set_scale > 0 ? set_scale : state.scale.millimetres_a_unit;
    SceneFacts& facts = state.facts;
    facts.has_skin = !state.skin_parts.empty();
    float reach = 0;
    for (const ActiveTarget& entry : state.active) reach += std::abs(entry.weight) * state.target_reach[entry.target];

    const ScatterProjection projection = scatter_projection(*state.view, state.millimetres_a_unit);
    const Camera& camera = state.view->camera;
    for (const SkinPart& part : state.skin_parts) {
        const glm::mat4& world = state.world_from_node[part.node];
        const glm::mat4 view = camera.view_from_world * world;
        Bounds bounds = part.bounds;
        bounds.low -= reach;
        bounds.high += reach;
        // Joints move a surface anywhere; then, and where a number is not finite, it may be seen, and be near.
        const bool known = !facts.has_joints && std::isfinite(reach) && std::isfinite(largest_scale(view));
        if (known && outside_view(clip_corners(camera.clip_from_view * view, bounds))) continue;
        facts.skin_on_screen = true;
        double nearest = 0;
        if (known) {
            nearest = std::numeric_limits<double>::max();
            for (const glm::vec4& corner : clip_corners(view, bounds)) {
                nearest = std::min(nearest, static_cast<double>(-corner.z) * state.millimetres_a_unit);
            }
        }
        const glm::dvec2 pixels = projection.pixels_a_mm(std::max(nearest, 0.0));
        facts.skin_pixels_a_mm = std::max({facts.skin_pixels_a_mm, pixels.x, pixels.y});
    }
}

}  // namespace blush
