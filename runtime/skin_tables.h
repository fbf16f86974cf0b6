#pragma once
/// The tables that shading skin reads, as textures; made when first asked for.

#include "runtime/character_state.h"

namespace blush {

struct SkinTables {
    gl::Texture beckmann, specular_albedo;  ///< rig/skin_reflectance.h
};

const SkinTables& skin_tables(CharacterState& state);

}  // namespace blush
