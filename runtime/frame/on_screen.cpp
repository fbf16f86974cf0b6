#include "runtime/frame/on_screen.h"

#include <cmath>

#include "runtime/frame/clip_bounds.h"

namespace blush {

bool may_be_on_screen(const FrameState& frame, const CharacterState& character) {
    const ViewFrame& view = *frame.view;
    // Joints and pins move it anywhere.
    if (character.facts.has_joints || character.facts.pinned || view.width == 0 || view.height == 0) return true;
    const Extents& extents = character.facts_of_face.extents;
    float reach = 0;
    for (const ActiveTarget& entry : character.active()) {
        reach += std::abs(entry.weight) * extents.target_reach[entry.target];
    }
    if (!std::isfinite(reach)) return true;
    const glm::mat4 clip_from_shading = frame.clip_from_view * character.view_from_shading;
    const glm::vec2 pixel = 2.0F / glm::vec2(view.width, view.height);
    return std::ranges::any_of(extents.parts, [&](const Extents::Part& part) {
        const Bounds bounds{part.bounds.low - reach, part.bounds.high + reach};
        return !outside_view(clip_corners(clip_from_shading * character.shading_from_node[part.node], bounds), pixel);
    });
}

std::string_view nothing_to_draw(const SceneFacts& facts) {
    return facts.has_triangles ? "no part of the face can be on the screen: the picture has no edges"
                               : "the face has nothing to draw: the picture has no edges";
}

Bounds moved_bounds(const CharacterState& character) {
    const Bounds& rest = character.facts_of_face.bounds;
    if (character.host_joints.empty() || rest.empty()) return rest;
    // The face goes where its joints go: each may hold any part of it.
    Bounds bounds;
    for (const glm::mat4& joint : character.host_joints) {
        for (std::size_t i = 0; i < 8; ++i) {
            const glm::vec3 corner((i & 1) != 0 ? rest.high.x : rest.low.x, (i & 2) != 0 ? rest.high.y : rest.low.y,
                                   (i & 4) != 0 ? rest.high.z : rest.low.z);
            bounds.add(glm::vec3(joint * glm::vec4(corner, 1)));
        }
    }
    return bounds;
}

}  // namespace blush
