#pragma once
/// The GPU side of a face's appearance maps, made when the first frame needs them, for all characters of the face.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rig/wrinkles/derivative_map.h"
#include "runtime/frame/frame_state.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

/// How the wrinkle map stands in memory.
enum class WrinkleStorage : std::uint8_t {
    compressed,  ///< RGTC2 (BC5, the paper's 3Dc): 8 bits a texel
    plain,       ///< two signed bytes a texel
    half_float,  ///< what the compressed ones are measured against
};

struct WrinkleTextures {
    gl::Texture derivatives, differences;                 ///< each made when its encoding is first asked for
    gl::Texture masks;                                    ///< a layer for every four zones
    WrinkleStorage storage = WrinkleStorage::compressed;  ///< of both maps
    std::uint64_t bytes = 0;                              ///< of the map in use with its mip levels, and the masks
};

struct BloodTextures {
    gl::Texture pigments, table;
    gl::Texture residual;             ///< made when the colour is first asked for from the pigments alone
    std::uint32_t table_nodes = 0;    ///< of a side of `table`
    gl::Texture changes;              ///< a layer for each map that the face has
    std::vector<std::int32_t> layer;  ///< of each of Rig::hemoglobin_maps(), -1 where the face has no map for it
    TextureShape blended_shape;       ///< of what a pose makes of them
    gl::Program blend_program;
};

/// Of one character.
struct BlendedBlood {
    gl::Texture texture;                       ///< the changes by the shares of the pose
    gl::Framebuffer framebuffer;               ///< draws into it
    std::optional<std::vector<float>> shares;  ///< what it holds, if anything yet
};

/// The pose's weight of each zone of the face's wrinkle maps; 0 for those that the rig does not know. `out` has one
/// entry a zone.
void zone_weights_of(const CharacterState& character, std::span<float> out);

/// Whether the skin's colour is residual * table(melanin, hemoglobin), not the texture's colour changed.
bool colour_from_pigments(const CharacterState& character);

WrinkleTextures& wrinkle_textures(CharacterState& character);
BloodTextures& blood_textures(CharacterState& character);
BlendedBlood& blended_blood(CharacterState& character);

/// The map of normal differences that stands for the same wrinkles (jimenez-2012, 8.2.1): at each texel, wrinkled minus
/// base. base: a tangent-space normal map of any size, or one without texels for a flat base.
Map<glm::vec3> normal_differences(const DerivativeMap& wrinkles, const NormalMap& base);

/// Blends the blood maps of the pose into the character's BlendedBlood.
void blend_blood(FrameState& frame, CharacterState& character);

}  // namespace blush
