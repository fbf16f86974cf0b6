#include "runtime/light/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "runtime/effects/shared_settings.h"

namespace blush {
namespace {

/// Side of a map as the settings want it; smaller where so many maps would not fit.
std::uint32_t map_side(const FrameState& frame, std::size_t count) {
    std::uint32_t side = 512U << frame.scene->settings.choice(shadows_size);
    const auto largest = static_cast<std::uint64_t>(frame.device.info().largest_texture_side_texels);
    constexpr std::uint32_t least_side = 64;
    const auto fits = [&](std::uint64_t s) {
        const std::uint64_t a_row = std::max<std::uint64_t>(1, largest / s);
        return s * s * count <= most_shadow_texels && (count + a_row - 1) / a_row * s <= largest;
    };
    while (side > least_side && !fits(side)) side /= 2;
    return side;
}

/// How much farther from a light than the receiver's sphere all that may cast into it begins.
double nearest_caster(const FrameState& frame, const LightSource& light, const CharacterState& receiver) {
    double result = 0;
    for (const CharacterState* caster : frame.characters) {
        double nearer = 0;
        if (caster != &receiver && casts_into(light, *caster, receiver, &nearer)) result = std::max(result, nearer);
    }
    return result;
}

}  // namespace

bool casts_into(const LightSource& light, const CharacterState& caster, const CharacterState& receiver,
                double* nearer) {
    if (&caster == &receiver) return true;
    const double r = receiver.radius_world, c = caster.radius_world;
    if (light.kind == LightKind::directional) {
        const glm::dvec3 along = glm::normalize(glm::dvec3(light.direction_world));
        const glm::dvec3 apart = caster.centre_world - receiver.centre_world;
        const double behind = glm::dot(apart, along);
        // The map is a square around the receiver's sphere.
        if (glm::length(apart - behind * along) > std::sqrt(2.0) * r + c || behind > r + c) return false;
        if (nearer != nullptr) *nearer = c - r - behind;
        return true;
    }
    const glm::dvec3 to_receiver = receiver.centre_world - light.position_world,
                     to_caster = caster.centre_world - light.position_world;
    const double receiver_distance = glm::length(to_receiver), caster_distance = glm::length(to_caster);
    if (caster_distance - c > receiver_distance + r) return false;
    if (nearer != nullptr) *nearer = (receiver_distance - r) - (caster_distance - c);
    if (caster_distance <= c || receiver_distance <= r) return true;
    const double angle =
        std::acos(std::clamp(glm::dot(to_receiver, to_caster) / (receiver_distance * caster_distance), -1.0, 1.0));
    const double half = std::atan(std::sqrt(2.0) * std::tan(std::asin(r / receiver_distance)));
    return angle <= half + std::asin(c / caster_distance);
}

void place_shadow_maps(FrameState& frame) {
    auto& maps = frame.scene->own<ShadowMaps>();
    maps.maps.clear();
    const bool off = frame.scene->settings.choice(shadows_method) == 1;
    const bool sharp = frame.scene->settings.choice(shadows_edges) == 1;
    for (CharacterState* character : frame.characters) {
        if (off) continue;
        for (std::size_t k = 0; k < character->reaching.size(); ++k) {
            const std::uint32_t l = character->reaching[k];
            const LightSource& source = frame.lights[l];
            if (!source.casts_shadow) continue;
            const std::optional<ShadowPlace> place = place_shadow_map(
                source, character->centre_world, character->radius_world, nearest_caster(frame, source, *character));
            if (!place) continue;
            // The tile follows once all maps are counted.
            character->shader_lights[k].shadow.x = static_cast<float>(maps.maps.size());
            ++character->shadow_lights;
            maps.maps.push_back({character->index, l, *place, {}});
        }
    }
    if (maps.maps.empty()) return;
    const std::uint32_t side = map_side(frame, maps.maps.size());
    const auto largest = static_cast<std::uint32_t>(frame.device.info().largest_texture_side_texels);
    const std::uint32_t a_row = std::max(1U, largest / side);
    for (CharacterState* character : frame.characters) {
        for (shared::Light& light : character->shader_lights) {
            if (light.shadow.x < 0) continue;
            const auto index = static_cast<std::uint32_t>(light.shadow.x);
            ShadowMaps::Map& map = maps.maps[index];
            map.tile = {index % a_row * side, index / a_row * side, side};
            write_shadow(map.place, map.tile, character->origin_world, light);
            if (sharp) light.shadow_depth.z = 0;
        }
    }
}

bool shadow_maps_current(const FrameState& frame) {
    const auto& maps = frame.scene->own<ShadowMaps>();
    const bool same_characters =
        std::ranges::equal(maps.drawn_characters, frame.characters,
                           [](const CharacterState* drawn, const CharacterState* now) { return drawn == now; });
    if (!maps.valid || !same_characters || maps.drawn_places.size() != maps.maps.size()) return false;
    if (!(maps.drawn_settings[0] == frame.scene->settings)) return false;
    for (std::size_t c = 0; c < frame.characters.size(); ++c) {
        const CharacterState& character = *frame.characters[c];
        if (!(maps.drawn_settings[c + 1] == character.settings) || !(maps.drawn_stances[c] == character.stance)) {
            return false;
        }
    }
    return std::ranges::equal(maps.maps, maps.drawn_places, {}, &ShadowMaps::Map::place);
}

void keep_shadow_maps(FrameState& frame) {
    auto& maps = frame.scene->own<ShadowMaps>();
    maps.drawn_places.clear();
    for (const ShadowMaps::Map& map : maps.maps) maps.drawn_places.push_back(map.place);
    maps.drawn_characters.assign(frame.characters.begin(), frame.characters.end());
    maps.drawn_stances.resize(frame.characters.size());
    maps.drawn_settings.resize(frame.characters.size() + 1);
    maps.drawn_settings[0] = frame.scene->settings;
    for (std::size_t c = 0; c < frame.characters.size(); ++c) {
        maps.drawn_stances[c] = frame.characters[c]->stance;
        maps.drawn_settings[c + 1] = frame.characters[c]->settings;
    }
    maps.valid = true;
}

}  // namespace blush
