#include "runtime/light/shadow_maps.h"

#include <algorithm>

#include "runtime/frame/effect.h"
#include "runtime/light/scene_lights.h"

namespace blush {

std::uint32_t shadow_map_side(const CharacterState& state) {
    return 512U << state.settings.choice(shadows_effect.name, "size");
}

void place_shadow_maps(CharacterState& state) {
    state.shader_lights.clear();
    std::uint32_t maps = 0;
    const std::uint32_t side = shadow_map_side(state);
    // Where the device's textures end, further lights shine without shadows.
    const std::uint32_t most = static_cast<std::uint32_t>(state.device.info().largest_texture_side_texels) / side;
    const bool sharp = state.settings.choice(shadows_effect.name, "edges") == 1;
    for (const LightSource& source : state.lights) {
        shared::Light light = shader_light(source);
        if (source.casts_shadow && maps < most && place_shadow_map(source, state.bounds, side, maps, light)) ++maps;
        if (sharp) light.shadow_depth.z = 0;
        state.shader_lights.push_back(light);
    }
}

std::uint32_t shadow_light_count(const CharacterState& state) {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(state.shader_lights, [](const shared::Light& light) { return light.shadow.x >= 0; }));
}

bool shadow_maps_current(const CharacterState& state) {
    const auto& maps = const_cast<CharacterState&>(state).own<ShadowMaps>();
    if (!maps.valid || maps.drawn_active != state.active || !(maps.drawn_settings == state.settings) ||
        maps.drawn_nodes != state.world_from_node || maps.drawn_joints != state.skinned_from_mesh) {
        return false;
    }
    std::size_t map = 0;
    for (const shared::Light& light : state.shader_lights) {
        if (light.shadow.x < 0) continue;
        if (map >= maps.drawn_views.size() || maps.drawn_views[map++] != light.shadow_from_world) return false;
    }
    return map == maps.drawn_views.size();
}

}  // namespace blush
