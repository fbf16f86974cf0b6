#pragma once
/// The tables that shading skin reads, as textures; made when first asked for.

#include "runtime/frame/frame_state.h"

namespace blush {

struct SkinTables {
    gl::Texture beckmann, specular_albedo;  ///< rig/light/skin_reflectance.h
};

const SkinTables& skin_tables(FrameState& frame);

}  // namespace blush
