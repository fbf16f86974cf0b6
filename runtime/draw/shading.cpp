#include "runtime/draw/shading.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cctype>
#include <cstring>
#include <string>

#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

std::string upper(std::string_view name) {
    std::string out;
    for (const char letter : name) out += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    return out;
}

bool takes_part(const FrameState& frame, const CharacterState& character, const Effect& effect) {
    const ShadingPart& part = *effect.shading;
    if (part.takes_part != nullptr) return part.takes_part(frame, character);
    return effect.need != nullptr ? frame.on(effect) : character.on(effect);
}

/// Textures of a part with its variants.
std::uint32_t textures_of(const ShadingPart& part, std::uint32_t variants) {
    std::uint32_t count = part.textures;
    for (std::size_t v = 0; v < part.variants.size(); ++v) {
        if ((variants >> v & 1U) != 0) count += part.variants[v].textures;
    }
    return count;
}

/// Calls visit(part of the layout, its ShadingPart, bits of its variants) for each of `shading`, in order.
template <class Visit>
void each_part(const ShadingLayout& layout, const Shading& shading, Visit visit) {
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        if ((shading.parts >> k & 1U) == 0) continue;
        visit(layout.parts[k], *layout.parts[k].effect->shading, shading.variants >> layout.parts[k].first_variant);
    }
}

/// Units that a part takes follow those of the material and of the parts before it.
template <class Visit>
void each_unit(const ShadingLayout& layout, const Permutation& permutation, Visit visit) {
    auto unit = static_cast<std::uint32_t>(std::popcount(permutation.textures));
    each_part(layout, permutation.shading,
              [&](const ShadingLayout::Part& place, const ShadingPart& part, std::uint32_t variants) {
                  const std::uint32_t count = textures_of(part, variants);
                  visit(place, part, unit, count);
                  unit += count;
              });
}

/// What of a character's shading concerns materials of a kind.
Shading shading_for(const ShadingLayout& layout, const CharacterState& character, MaterialKind kind,
                    bool& model_of_its_own) {
    Shading result;
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        if ((character.shading.parts >> k & 1U) == 0) continue;
        const ShadingPart& part = *layout.parts[k].effect->shading;
        if ((part.materials & materials_of(kind)) == 0) continue;
        if (part.gives_model != nullptr) {
            if (!part.gives_model(character, kind)) continue;
            model_of_its_own = true;
        }
        result.parts |= 1U << k;
        const std::uint32_t variants = (1U << part.variants.size()) - 1;
        result.variants |= character.shading.variants & (variants << layout.parts[k].first_variant);
    }
    return result;
}

std::string include_line(std::string_view file) { return "#include \"" + std::string(file) + "\"\n"; }

}  // namespace

ShadingLayout::ShadingLayout() {
    block.name = "EffectsBlock";
    std::uint32_t variant = 0;
    for (const Effect* effect : effects()) {
        if (effect->shading == nullptr) continue;
        const ShadingUniforms& uniforms = effect->shading->uniforms;
        parts.push_back({effect, block.bytes, variant});
        for (const UniformField& field : uniforms.fields) {
            block.fields.push_back(
                {std::string(effect->name) + "." + std::string(field.name), block.bytes + field.offset});
        }
        block.bytes += uniforms.bytes;
        variant += static_cast<std::uint32_t>(effect->shading->variants.size());
    }
    assert(parts.size() <= 32 && variant <= 32 && "Shading has a bit for each");
}

const ShadingLayout& shading_layout(DeviceState& device) { return device.store.get<ShadingLayout>(); }

Shading shading_of(const FrameState& frame, const CharacterState& character) {
    Shading result;
    const ShadingLayout& layout = shading_layout(frame.shared);
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        const Effect& effect = *layout.parts[k].effect;
        if (!takes_part(frame, character, effect)) continue;
        result.parts |= 1U << k;
        if (effect.shading->variant != nullptr)
            result.variants |= effect.shading->variant(frame, character) << layout.parts[k].first_variant;
    }
    return result;
}

Permutation permutation_of(const CharacterState& character, std::int32_t material) {
    const Face& face = character.face;
    const MaterialKind kind =
        character.facts_of_face
            .material_kind[material >= 0 ? static_cast<std::size_t>(material) : face.materials.size()];
    Permutation result;
    bool model_of_its_own = kind == MaterialKind::skin;
    result.shading = shading_for(shading_layout(character.device.state()), character, kind, model_of_its_own);
    if (model_of_its_own) result.model = kind;
    result.textures = material_textures(face, material);
    return result;
}

std::uint32_t shading_units(DeviceState& device, const CharacterState& character, const Shading& shading) {
    std::uint32_t most = 0;
    for (std::size_t m = 0; m <= character.face.materials.size(); ++m) {
        const auto material = m == character.face.materials.size() ? -1 : static_cast<std::int32_t>(m);
        Permutation permutation;
        permutation.textures = material_textures(character.face, material);
        const MaterialKind kind = character.facts_of_face.material_kind[m];
        const ShadingLayout& layout = shading_layout(device);
        permutation.shading = shading;
        std::uint32_t units = static_cast<std::uint32_t>(std::popcount(permutation.textures));
        each_part(layout, shading, [&](const ShadingLayout::Part&, const ShadingPart& part, std::uint32_t variants) {
            if ((part.materials & materials_of(kind)) != 0) units += textures_of(part, variants);
        });
        most = std::max(most, units);
    }
    return most;
}

ShadingSource shading_source(DeviceState& device, const Permutation& permutation) {
    const ShadingLayout& layout = shading_layout(device);
    ShadingSource source;
    if (permutation.model != MaterialKind::other) {
        constexpr std::array<const char*, 4> models = {"SKIN", "EYE", "MOUTH", "HAIR"};
        source.defines.emplace_back(models[static_cast<std::size_t>(permutation.model)]);
    }
    material_defines(permutation.textures, source.defines);

    gl::Insertions& into = source.insertions;
    std::string &uniforms = into.texts["uniforms"], block;
    for (const ShadingLayout::Part& place : layout.parts) {
        const ShadingUniforms& of = place.effect->shading->uniforms;
        const std::span<const EmbeddedShader> files = place.effect->shading->own_files;
        into.files.insert(into.files.end(), files.begin(), files.end());
        if (of.bytes == 0) continue;
        uniforms += include_line(of.file);
        block.append(of.type).append(" ").append(place.effect->name).append("; ");
    }
    if (!block.empty())
        uniforms += "layout(std140, binding = BLUSH_EFFECTS_BINDING) uniform EffectsBlock { " + block + "};\n";
    into.blocks.push_back(layout.block);

    std::uint32_t output = 1;
    each_unit(
        layout, permutation,
        [&](const ShadingLayout::Part& place, const ShadingPart& part, std::uint32_t unit, std::uint32_t textures) {
            const std::string name = upper(place.effect->name);
            if (textures != 0) source.defines.push_back(name + "_UNIT " + std::to_string(unit));
            if (!part.targets.empty()) source.defines.push_back(name + "_OUTPUT " + std::to_string(output));
            output += static_cast<std::uint32_t>(part.targets.size());
            if (!part.file.empty()) into.texts["effects"] += include_line(part.file);
            if (!part.vertex_file.empty()) into.texts["vertex_effects"] += include_line(part.vertex_file);
            if (!part.output_file.empty()) into.texts["output_effects"] += include_line(part.output_file);
            for (const std::string_view hook : part.hooks) {
                into.calls[std::string(hook)].push_back(std::string(place.effect->name) + "_" + std::string(hook));
            }
        });
    each_part(layout, permutation.shading,
              [&](const ShadingLayout::Part&, const ShadingPart& part, std::uint32_t variants) {
                  for (std::size_t v = 0; v < part.variants.size(); ++v) {
                      if ((variants >> v & 1U) != 0) source.defines.emplace_back(part.variants[v].define);
                  }
              });
    return source;
}

Result<gl::Program> make_shading_program(DeviceState& device, const Permutation& permutation, std::string_view vertex,
                                         std::string_view fragment) {
    const ShadingSource source = shading_source(device, permutation);
    const std::vector<std::string_view> defines(source.defines.begin(), source.defines.end());
    return gl::make_program(
        {.vertex = vertex, .fragment = fragment, .defines = defines, .insertions = &source.insertions});
}

gl::Program shade_program(DeviceState& device, const Permutation& permutation) {
    gl::Program& program = device.store.get<ShadePrograms>().made[permutation];
    if (program) return program;
    const ShadingSource source = shading_source(device, permutation);
    const std::vector<std::string_view> defines(source.defines.begin(), source.defines.end());
    gl::require_program(program, {.vertex = "draw/face.vert",
                                  .fragment = "draw/face.frag",
                                  .defines = defines,
                                  .insertions = &source.insertions});
    return program;
}

void write_effects_block(const FrameState& frame, CharacterState& character) {
    const ShadingLayout& layout = shading_layout(frame.shared);
    std::vector<std::byte>& staging = character.effects_staging;
    staging.assign(layout.block.bytes, std::byte{0});
    each_part(layout, character.shading, [&](const ShadingLayout::Part& place, const ShadingPart& part, std::uint32_t) {
        if (part.uniforms.write != nullptr) part.uniforms.write(frame, character, &staging[place.offset]);
    });
    if (staging.empty()) return;
    if (!character.effects_block)
        character.effects_block = gl::make_buffer(staging.size(), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(character.effects_block.name(), 0, static_cast<GLsizeiptr>(staging.size()), staging.data());
}

void bind_effects(FrameState& frame, CharacterState& character, const Permutation& permutation) {
    if (character.effects_block)
        glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_EFFECTS_BINDING, character.effects_block.name());
    each_unit(shading_layout(frame.shared), permutation,
              [&](const ShadingLayout::Part&, const ShadingPart& part, std::uint32_t unit, std::uint32_t textures) {
                  for (std::uint32_t t = 0; t < textures; ++t) glBindSampler(unit + t, 0);
                  if (part.bind != nullptr) part.bind(frame, character, unit);
              });
}

}  // namespace blush
