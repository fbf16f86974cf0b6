#pragma once
/// Shading as the registry of effects makes it: what takes part for a character, permutations, their programs, and what
/// is bound for them. No effect is known by name here.

#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/shading_part.h"
#include "runtime/gl/program.h"

namespace blush {

/// Parts that effects bring to shading, in the order of the registry, and how their uniforms lie in one block.
struct ShadingLayout {
    struct Part {
        const Effect* effect = nullptr;
        std::size_t offset = 0;           ///< of its uniforms in the block, bytes
        std::uint32_t first_variant = 0;  ///< bit of Shading::variants
    };
    std::vector<Part> parts;
    gl::BlockLayout block;  ///< "EffectsBlock"

    ShadingLayout();
};

/// What tells one program of shading from another.
struct Permutation {
    MaterialKind model = MaterialKind::other;
    std::uint32_t textures = 0;  ///< of the material: material_textures()
    Shading shading;

    auto operator<=>(const Permutation&) const = default;
};

const ShadingLayout& shading_layout(DeviceState& device);
/// What takes part for a character in the frame; its needs are found.
Shading shading_of(const FrameState& frame, const CharacterState& character);
/// For one of its materials (-1: the default one).
Permutation permutation_of(const CharacterState& character, std::int32_t material);
/// Texture units that shading one of the character's materials takes, at most, if `shading` takes part.
std::uint32_t shading_units(DeviceState& device, const CharacterState& character, const Shading& shading);

/// The insertions and defines of a permutation's files.
struct ShadingSource {
    std::vector<std::string> defines;
    gl::Insertions insertions;
};
ShadingSource shading_source(DeviceState& device, const Permutation& permutation);
/// Of a device.
struct ShadePrograms {
    std::map<Permutation, gl::Program> made;
};
/// The program of a permutation, made where it is not there yet; none where that fails (gl::require_program).
gl::Program shade_program(DeviceState& device, const Permutation& permutation);
/// The same with files of the caller's own.
Result<gl::Program> make_shading_program(DeviceState& device, const Permutation& permutation, std::string_view vertex,
                                         std::string_view fragment);

/// Fills and binds the block of all that takes part.
void write_effects_block(const FrameState& frame, CharacterState& character);
/// Binds what the effects of a permutation read for a character.
void bind_effects(FrameState& frame, CharacterState& character, const Permutation& permutation);

/// Number of targets beside the scene's colour that the frame's effects write.
template <class Visit>
void each_shading_target(const FrameState& frame, Visit visit) {
    for (const Effect* effect : effects()) {
        if (effect->shading == nullptr || !frame.on(*effect)) continue;
        for (std::size_t t = 0; t < effect->shading->targets.size(); ++t)
            visit(*effect, effect->shading->targets[t], t);
    }
}

}  // namespace blush
