#include "runtime/appearance/appearance_gpu.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "rig/blood/skin_colour_table.h"
#include "rig/wrinkles/texture_bytes.h"
#include "runtime/appearance/signed_texture.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/files/wrinkle_bake.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

gl::Texture texture_2d(GLenum format, std::uint32_t width, std::uint32_t height, int levels = 1) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), levels, format, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

template <class Texel>
void upload(const gl::Texture& texture, std::uint32_t width, std::uint32_t height, GLenum format, GLenum type,
            const std::vector<Texel>& texels, int level = 0) {
    // Rows of one or two bytes a texel need not end on four bytes.
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture.name(), level, 0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), format,
                        type, texels.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

int levels_of(std::uint32_t width, std::uint32_t height) {
    return 1 + static_cast<int>(std::log2(std::max({width, height, 1U})));
}

gl::Texture derivative_texture(const WrinkleSet& set, WrinkleStorage storage) {
    constexpr std::array<GLenum, 3> formats = {GL_COMPRESSED_SIGNED_RG_RGTC2, GL_RG8_SNORM, GL_RG16F};
    Map<glm::vec3> scaled(set.derivatives.width, set.derivatives.height);
    for (std::size_t i = 0; i < scaled.values.size(); ++i)
        scaled.values[i] = glm::vec3(set.derivatives.values[i] / set.range, 0);
    return make_signed_texture(formats[static_cast<std::size_t>(storage)], std::move(scaled), 2);
}

/// Differences need three channels, which RGTC has not (8.2.1): plain bytes, or half floats.
gl::Texture difference_texture(const Map<glm::vec3>& map, WrinkleStorage storage) {
    return make_signed_texture(storage == WrinkleStorage::half_float ? GL_RGB16F : GL_RGB8_SNORM, map, 3);
}

gl::Texture mask_texture(const std::vector<ScalarMap>& masks) {
    const auto width = static_cast<GLsizei>(masks[0].width), height = static_cast<GLsizei>(masks[0].height);
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D_ARRAY);
    const std::size_t layers = wrinkle_masks_for(masks.size());
    glTextureStorage3D(texture.name(), 1, GL_RGBA8, width, height, static_cast<GLsizei>(layers));
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    const std::size_t texels = masks[0].values.size();
    for (std::size_t layer = 0; layer < layers; ++layer) {
        std::vector<std::uint8_t> bytes(4 * texels, 0);
        for (std::size_t c = 0; c < 4 && 4 * layer + c < masks.size(); ++c) {
            const ScalarMap& mask = masks[4 * layer + c];
            for (std::size_t i = 0; i < texels; ++i)
                bytes[4 * i + c] = static_cast<std::uint8_t>(mask.values[i] * 255.0F + 0.5F);
        }
        glTextureSubImage3D(texture.name(), 0, 0, 0, static_cast<GLint>(layer), width, height, 1, GL_RGBA,
                            GL_UNSIGNED_BYTE, bytes.data());
    }
    return texture;
}
static_assert(most_wrinkle_masks == BLUSH_MOST_WRINKLE_MASKS);

/// The base normal map of the skin, or one without texels.
NormalMap base_normals(const CharacterState& character) {
    NormalMap base;
    for (std::size_t m = 0; m < character.face.materials.size(); ++m) {
        const Material& material = character.face.materials[m];
        if (!character.facts_of_face.skin.material[m] || material.normal.image < 0) continue;
        const Image& image = character.face.images[static_cast<std::size_t>(material.normal.image)];
        if (image.channels < 3) continue;
        base = normals_of(image);
        for (glm::vec3& normal : base.values) {
            normal.x *= material.normal_scale;
            normal.y *= material.normal_scale;
        }
        return base;
    }
    return base;
}

/// Maps of a part of the layout do not repeat: what lies outside meets their outermost texels.
void end_at_part(const gl::Texture& texture, const WrinkleSet& set) {
    if (set.part.is_whole()) return;
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

/// A map of the layout as a map of the part that wrinkles show.
NormalMap part_of(NormalMap map, const WrinkleSet& set) {
    if (set.part.is_whole() || map.values.empty()) return map;
    NormalMap part(set.derivatives.width, set.derivatives.height);
    for (std::uint32_t y = 0; y < part.height; ++y) {
        for (std::uint32_t x = 0; x < part.width; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5F) / glm::vec2(part.width, part.height);
            part.at(x, y) = sample(map, glm::mix(set.part.from, set.part.to, uv));
        }
    }
    return part;
}

std::vector<std::uint8_t> pigment_texels(const AppearanceMaps& maps) {
    std::vector<std::uint8_t> texels;
    texels.reserve(4 * maps.skin.values.size());
    for (std::size_t i = 0; i < maps.skin.values.size(); ++i) {
        texels.push_back(stored_byte(maps.melanin.values[i], largest_melanin));
        texels.push_back(stored_byte(maps.hemoglobin.values[i], largest_hemoglobin));
        texels.push_back(static_cast<std::uint8_t>(std::clamp(maps.skin.values[i], 0.0F, 1.0F) * 255.0F + 0.5F));
        texels.push_back(255);
    }
    return texels;
}

}  // namespace

Map<glm::vec3> normal_differences(const DerivativeMap& wrinkles, const NormalMap& base) {
    Map<glm::vec3> differences(wrinkles.width, wrinkles.height);
    const NormalMap fitted = base.values.empty() ? NormalMap() : resized(base, wrinkles.width, wrinkles.height);
    for (std::size_t i = 0; i < differences.values.size(); ++i) {
        glm::vec3 flat(0, 0, 1);
        if (!fitted.values.empty() && glm::dot(fitted.values[i], fitted.values[i]) > 1e-12F)
            flat = glm::normalize(fitted.values[i]);
        const glm::vec3 wrinkled(glm::vec2(flat) + wrinkles.values[i] * flat.z, flat.z);
        differences.values[i] = normal_difference(glm::normalize(wrinkled), flat);
    }
    return differences;
}

WrinkleTextures& wrinkle_textures(CharacterState& character) {
    const WrinkleSet& set = *character.asset.appearance().wrinkles;
    const auto storage = static_cast<WrinkleStorage>(character.settings.choice(wrinkles_storage));
    WrinkleTextures& textures =
        character.model->own<std::array<WrinkleTextures, 3>>()[static_cast<std::size_t>(storage)];
    textures.storage = storage;
    const bool differences = character.settings.choice(wrinkles_encoding) == 1;
    if (!textures.masks) {
        textures.masks = mask_texture(set.masks);
        end_at_part(textures.masks, set);
    }
    if (!differences && !textures.derivatives) {
        textures.derivatives = derivative_texture(set, storage);
        end_at_part(textures.derivatives, set);
    }
    if (differences && !textures.differences) {
        const NormalMap base = part_of(base_normals(character), set);
        textures.differences = difference_texture(normal_differences(set.derivatives, base), storage);
        end_at_part(textures.differences, set);
    }

    const auto map_bytes = [&](std::uint32_t width, std::uint32_t height) {
        constexpr std::array<std::uint64_t, 3> derivative_bytes = {0, 2, 4}, difference_bytes = {3, 3, 6};
        const auto& a_texel = differences ? difference_bytes : derivative_bytes;
        const std::uint64_t bytes = a_texel[static_cast<std::size_t>(storage)];
        return bytes == 0 ? rgtc2_bytes(width, height) : bytes * width * height;
    };
    textures.bytes =
        with_mip_levels(set.derivatives.width, set.derivatives.height, map_bytes) + wrinkle_bytes(set).masks;
    return textures;
}

void zone_weights_of(const CharacterState& character, std::span<float> out) {
    const std::span<const std::string> known = character.rig.wrinkle_zones();
    const std::vector<std::string>& zones = character.asset.appearance().wrinkles->zones;
    for (std::size_t z = 0; z < zones.size(); ++z) {
        const auto found = std::ranges::find(known, zones[z]);
        out[z] = found == known.end() ? 0 : character.pose.wrinkles[static_cast<std::size_t>(found - known.begin())];
    }
}

bool colour_from_pigments(const CharacterState& character) { return character.settings.choice(blood_colour) == 1; }

namespace {

void make_table(BloodTextures& textures, std::uint32_t nodes) {
    if (textures.table_nodes == nodes) return;
    textures.table_nodes = nodes;
    const SkinColourTable table(nodes, nodes);
    // Four channels: texels of three halves are slow to fetch, for software rasterisers and some GPUs alike.
    std::vector<glm::vec4> texels;
    for (const glm::vec3& colour : table.texels()) texels.emplace_back(colour, 1);
    textures.table = texture_2d(GL_RGBA16F, nodes, nodes);
    upload(textures.table, nodes, nodes, GL_RGBA, GL_FLOAT, texels);
    glTextureParameteri(textures.table.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(textures.table.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void make_residual(BloodTextures& textures, const ColourMap& map) {
    if (textures.residual) return;
    constexpr float largest_half = 65504;
    std::vector<glm::vec4> texels;
    for (const glm::vec3& factor : map.values)
        texels.emplace_back(glm::clamp(factor, glm::vec3(0), glm::vec3(largest_half)), 1);
    textures.residual = texture_2d(GL_RGBA16F, map.width, map.height, levels_of(map.width, map.height));
    upload(textures.residual, map.width, map.height, GL_RGBA, GL_FLOAT, texels);
    glGenerateTextureMipmap(textures.residual.name());
}

}  // namespace

BloodTextures& blood_textures(CharacterState& character) {
    BloodTextures& textures = character.model->own<BloodTextures>();
    const SkinPigments& pigments = *character.asset.appearance().pigments;
    make_table(textures, static_cast<std::uint32_t>(character.settings.number(blood_table_nodes)));
    if (colour_from_pigments(character)) make_residual(textures, pigments.maps.residual);
    gl::require_program(textures.blend_program, {"screen.vert", "blood/blood_change.frag"});
    if (textures.pigments) return textures;
    const std::uint32_t width = pigments.maps.skin.width, height = pigments.maps.skin.height;
    const int levels = levels_of(width, height);
    textures.pigments = texture_2d(GL_RGBA8, width, height, levels);
    upload(textures.pigments, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pigment_texels(pigments.maps));
    glGenerateTextureMipmap(textures.pigments.name());

    const HemoglobinMaps& blood = pigments.blood;
    for (const std::string& name : character.rig.hemoglobin_maps()) {
        const auto found = std::ranges::find(blood.names, name);
        textures.layer.push_back(found == blood.names.end() ? -1 : static_cast<int>(found - blood.names.begin()));
    }
    const std::uint32_t change_width = blood.changes.empty() ? 1 : blood.changes[0].scale.width;
    const std::uint32_t change_height = blood.changes.empty() ? 1 : blood.changes[0].scale.height;
    textures.changes = gl::make_texture(GL_TEXTURE_2D_ARRAY);
    glTextureStorage3D(textures.changes.name(), 1, GL_RG16F, static_cast<GLsizei>(change_width),
                       static_cast<GLsizei>(change_height),
                       static_cast<GLsizei>(std::max<std::size_t>(1, blood.names.size())));
    glTextureParameteri(textures.changes.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    for (std::size_t layer = 0; layer < blood.changes.size(); ++layer) {
        std::vector<glm::vec2> texels(blood.changes[layer].scale.values.size());
        for (std::size_t i = 0; i < texels.size(); ++i)
            texels[i] = {blood.changes[layer].scale.values[i], blood.changes[layer].offset.values[i]};
        glTextureSubImage3D(textures.changes.name(), 0, 0, 0, static_cast<GLint>(layer),
                            static_cast<GLsizei>(change_width), static_cast<GLsizei>(change_height), 1, GL_RG, GL_FLOAT,
                            texels.data());
    }
    textures.blended_shape = {PixelFormat::rg16f, change_width, change_height, 1};
    return textures;
}

BlendedBlood& blended_blood(CharacterState& character) {
    auto& blended = character.own<BlendedBlood>();
    if (blended.texture) return blended;
    const TextureShape& shape = blood_textures(character).blended_shape;
    blended.texture = texture_2d(GL_RG16F, shape.width, shape.height);
    blended.framebuffer = gl::make_framebuffer();
    glNamedFramebufferTexture(blended.framebuffer.name(), GL_COLOR_ATTACHMENT0, blended.texture.name(), 0);
    return blended;
}

void blend_blood(FrameState& frame, CharacterState& character) {
    const BloodTextures& textures = blood_textures(character);
    BlendedBlood& blended = blended_blood(character);
    std::array<glm::ivec4, BLUSH_MOST_BLOOD_MAPS / 4> layers{};
    std::array<glm::vec4, BLUSH_MOST_BLOOD_MAPS / 4> shares{};
    int count = 0;
    for (std::size_t m = 0; m < character.pose.hemoglobin.size() && count < BLUSH_MOST_BLOOD_MAPS; ++m) {
        if (character.pose.hemoglobin[m] == 0 || textures.layer[m] < 0) continue;
        const auto slot = static_cast<std::size_t>(count);
        layers[slot / 4][static_cast<glm::length_t>(slot % 4)] = textures.layer[m];
        shares[slot / 4][static_cast<glm::length_t>(slot % 4)] = character.pose.hemoglobin[m];
        ++count;
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, blended.framebuffer.name());
    glViewport(0, 0, static_cast<GLsizei>(textures.blended_shape.width),
               static_cast<GLsizei>(textures.blended_shape.height));
    glUseProgram(textures.blend_program.name());
    glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, textures.changes.name());
    glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
    glUniform1i(0, count);
    glUniform4iv(1, static_cast<GLsizei>(layers.size()), &layers[0].x);
    glUniform4fv(1 + BLUSH_MOST_BLOOD_MAPS / 4, static_cast<GLsizei>(shares.size()), &shares[0].x);
    draw_screen(frame);
    blended.shares = character.pose.hemoglobin;
}

}  // namespace blush
