#pragma once
/// Shadow maps of a character: one depth texture, the lights' maps side by side, kept while nothing moves.

#include "runtime/frame/character_state.h"

namespace blush {

struct ShadowMaps {
    gl::Program program;
    gl::Texture depth;
    gl::Sampler nearest;
    gl::Framebuffer framebuffer;
    std::uint32_t side_texels = 0, count = 0;

    // What the maps were drawn from.
    bool valid = false;
    std::vector<glm::mat4> drawn_views, drawn_nodes, drawn_joints;
    std::vector<ActiveTarget> drawn_active;
    EffectSettings drawn_settings;
};

/// Side of a light's map, as the settings want it.
std::uint32_t shadow_map_side(const CharacterState& state);

/// Finds which lights get a map and where it looks; before the needs are found.
void place_shadow_maps(CharacterState& state);

/// Lights of this frame that have a map. Known once they are placed.
std::uint32_t shadow_light_count(const CharacterState& state);

/// Whether the maps that stand are what would be drawn now.
bool shadow_maps_current(const CharacterState& state);

}  // namespace blush
