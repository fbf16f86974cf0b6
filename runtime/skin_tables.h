#pragma once
/// The tables that shading skin reads, as textures; made when first asked for.

#include "runtime/character_state.h"

namespace blush {

struct SkinTables {
    gl::Texture beckmann, specular_albedo;  ///< rig/skin_reflectance.h
    gl::Texture transmittance;              ///< T(s), rgb, from 0 to BLUSH_TRANSMITTANCE_END_MM
    std::uint8_t attenuation = 0xff;        ///< which T(s) the last one holds
};

/// With T(s) as the settings want it.
const SkinTables& skin_tables(CharacterState& state);

}  // namespace blush
