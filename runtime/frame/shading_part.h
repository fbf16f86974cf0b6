#pragma once
/// What an effect brings to shading: functions for the hooks of shaders/draw/hooks.glsl, numbers, textures, targets.
/// Permutations, the uniform block, texture units and bindings follow from the registry (runtime/draw/shading.h).

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "rig/head/material_kind.h"
#include "runtime/frame/frame_graph.h"
#include "shaders/embedded.h"

namespace blush {

struct CharacterState;
struct Effect;
struct FrameState;

/// A field of a struct that GLSL and C++ share.
struct UniformField {
    std::string_view name;  ///< as GLSL has it: "weights[0]"
    std::size_t offset = 0;
};

/// An effect's numbers for one character in one picture: a struct of floats, ints, vec4, ivec4 and mat4 in a file that
/// is valid in both languages, its size a multiple of 16. Shaders read it by the effect's name: wrinkles.range.
struct ShadingUniforms {
    std::string_view file;  ///< "wrinkles/wrinkles_uniforms.glsl"
    std::string_view type;  ///< "WrinklesUniforms"
    std::size_t bytes = 0;
    std::span<const UniformField> fields;
    /// `to`: the struct, zeros.
    void (*write)(const FrameState&, CharacterState&, void* to) = nullptr;
};

/// A further program of the same part.
struct ShadingVariant {
    std::string_view define;
    std::uint32_t textures = 0;  ///< beyond ShadingPart::textures
};

/// A target that shading writes beside the scene's colour.
struct ShadingTarget {
    std::string_view name, multisampled_name;
    PixelFormat format = PixelFormat::rgba16f;
};

/// Materials of these kinds.
template <class... Kinds>
constexpr std::uint32_t materials_of(Kinds... kinds) {
    return ((1U << static_cast<unsigned>(kinds)) | ...);
}
inline constexpr std::uint32_t all_materials = ~0U;

struct ShadingPart {
    /// Files in shaders/, each where its hooks stand: between surface and light, for each vertex (`visibility`),
    /// forward alone (`output`). They have a function NAME_HOOK for each of `hooks`, NAME being the effect's.
    std::string_view file = {}, vertex_file = {}, output_file = {};
    std::span<const EmbeddedShader> own_files = {};  ///< that are not in shaders/
    std::span<const std::string_view> hooks = {};
    const Effect* builds_on = nullptr;        ///< whose functions it calls: without that one it takes no part
    std::uint32_t materials = all_materials;  ///< materials_of()
    /// Whether a character is shaded with it in this frame; null: where the effect is on.
    bool (*takes_part)(const FrameState&, const CharacterState&) = nullptr;
    /// Whether materials of that kind have a surface model of their own (shaders/draw/model.glsl) through this effect;
    /// where not, it leaves them alone. Null: it changes no model.
    bool (*gives_model)(const CharacterState&, MaterialKind) = nullptr;
    std::span<const ShadingVariant> variants = {};
    /// Bit k: variants[k].
    std::uint32_t (*variant)(const FrameState&, const CharacterState&) = nullptr;
    ShadingUniforms uniforms = {};
    /// Its texture units follow one another from NAME_UNIT on, as GLSL has it.
    std::uint32_t textures = 0;
    /// Binds textures, from that unit on, and storage blocks. Samplers are none before it is asked.
    void (*bind)(FrameState&, CharacterState&, std::uint32_t first_unit) = nullptr;
    /// From location NAME_OUTPUT on, as GLSL has it; cleared to 0.
    std::span<const ShadingTarget> targets = {};
    /// Tells the graph what shading reads of the frame's resources.
    void (*reads)(FrameState&) = nullptr;
};

/// What shades one character in one picture.
struct Shading {
    std::uint32_t parts = 0;     ///< bit k: of the k-th effect with a ShadingPart
    std::uint32_t variants = 0;  ///< of all parts

    auto operator<=>(const Shading&) const = default;
};

}  // namespace blush
