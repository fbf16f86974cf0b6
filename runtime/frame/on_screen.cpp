#include "runtime/frame/on_screen.h"

#include <cmath>

#include "runtime/frame/clip_bounds.h"

namespace blush {
namespace {

/// Of the whole face, whatever its materials; found when first asked for.
struct Extents {
    bool found = false;
    struct Part {
        std::size_t node = 0;
        Bounds bounds;  ///< in its mesh, at rest
    };
    std::vector<Part> parts;
    std::vector<float> target_reach;  ///< of each target: its longest move at weight 1, mesh units
};

void find_extents(const Face& face, Extents& extents) {
    extents.found = true;
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        Bounds bounds;
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
                bounds.add(face.positions[primitive.first_vertex + v]);
            }
        }
        if (mesh.primitive_count != 0) extents.parts.push_back({n, bounds});
    }
    for (const Target& target : face.targets) {
        float reach = 0;
        for (const glm::vec3& delta : target.position_deltas) reach = std::max(reach, glm::length(delta));
        extents.target_reach.push_back(reach);
    }
}

}  // namespace

bool may_be_on_screen(CharacterState& state, const View& view) {
    if (state.facts.has_joints || view.width == 0 || view.height == 0) return true;  // joints move a surface anywhere
    auto& extents = state.own<Extents>();
    if (!extents.found) find_extents(state.face, extents);
    float reach = 0;
    for (const ActiveTarget& entry : state.active) reach += std::abs(entry.weight) * extents.target_reach[entry.target];
    if (!std::isfinite(reach)) return true;
    const glm::mat4 clip_from_world = view.camera.clip_from_view * view.camera.view_from_world;
    const glm::vec2 pixel = 2.0F / glm::vec2(view.width, view.height);
    return std::ranges::any_of(extents.parts, [&](const Extents::Part& part) {
        const Bounds bounds{part.bounds.low - reach, part.bounds.high + reach};
        return !outside_view(clip_corners(clip_from_world * state.world_from_node[part.node], bounds), pixel);
    });
}

std::string_view nothing_to_draw(const SceneFacts& facts) {
    return facts.has_triangles ? "no part of the face can be on the screen: the picture has no edges"
                               : "the face has nothing to draw: the picture has no edges";
}

}  // namespace blush
