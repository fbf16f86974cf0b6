#pragma once
/// Shadow maps of a scene: one depth texture of square tiles, one for each light of each character that it reaches,
/// kept while nothing moves and shared by all views.

#include "runtime/frame/frame_state.h"

namespace blush {

struct ShadowMaps {
    /// The map of one light for one character.
    struct Map {
        std::uint32_t character = 0;  ///< index in the frame
        std::uint32_t light = 0;      ///< of FrameState::lights
        ShadowPlace place;
        ShadowTile tile;
    };
    gl::Program program;
    gl::Texture depth;
    gl::Sampler nearest;
    gl::Framebuffer framebuffer;
    std::uint32_t width = 0, height = 0;  ///< of `depth`, texels
    std::vector<Map> maps;                ///< of this frame

    // What the maps that stand were drawn from.
    bool valid = false;
    std::vector<ShadowPlace> drawn_places;
    std::vector<Stance> drawn_stances;
    std::vector<const CharacterState*> drawn_characters;
    std::vector<EffectSettings> drawn_settings;  ///< of the scene and, then, of the characters
};

/// Texels that all maps of a scene have together, at most, as long as each has 64 of a side: sixteen of 1024 x 1024.
inline constexpr std::uint64_t most_shadow_texels = std::uint64_t{16} << 20;

/// Finds which lights get a map for which character, where each looks and where it stands in the texture, and writes
/// the characters' lights; before the needs are found.
void place_shadow_maps(FrameState& frame);

/// Whether `caster` may stand between a light and what its map for `receiver` shows, itself included. nearer: by how
/// much it is nearer to the light than the receiver's sphere, world units.
bool casts_into(const LightSource& light, const CharacterState& caster, const CharacterState& receiver,
                double* nearer = nullptr);

/// Whether the maps that stand are what would be drawn now.
bool shadow_maps_current(const FrameState& frame);

/// Remembers that they were drawn.
void keep_shadow_maps(FrameState& frame);

}  // namespace blush
