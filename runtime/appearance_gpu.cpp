#include "runtime/appearance_gpu.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "rig/skin_colour_table.h"
#include "runtime/effect.h"
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

/// The first `channels` of a map within -1..1, with its mip levels: without them folds flicker once they are narrower
/// than a pixel. The levels are averaged here, since GL does not make those of compressed textures.
gl::Texture signed_texture(GLenum format, Map<glm::vec3> map, std::size_t channels, bool floats) {
    const int levels = levels_of(map.width, map.height);
    gl::Texture texture = texture_2d(format, map.width, map.height, levels);
    const GLenum components = channels == 2 ? GL_RG : GL_RGB;
    for (int level = 0; level < levels; ++level) {
        if (level > 0) map = resized(map, std::max(map.width / 2, 1U), std::max(map.height / 2, 1U));
        std::vector<float> values;
        std::vector<std::int8_t> bytes;
        for (const glm::vec3& texel : map.values) {
            for (std::size_t c = 0; c < channels; ++c) {
                values.push_back(texel[static_cast<glm::length_t>(c)]);
                bytes.push_back(stored_derivative(values.back(), 1));
            }
        }
        if (floats) {
            upload(texture, map.width, map.height, components, GL_FLOAT, values, level);
        } else {
            upload(texture, map.width, map.height, components, GL_BYTE, bytes, level);
        }
    }
    return texture;
}

/// Compression is the driver's own.
gl::Texture derivative_texture(const WrinkleSet& set, WrinkleStorage storage) {
    constexpr std::array<GLenum, 3> formats = {GL_COMPRESSED_SIGNED_RG_RGTC2, GL_RG8_SNORM, GL_RG16F};
    Map<glm::vec3> scaled(set.derivatives.width, set.derivatives.height);
    for (std::size_t i = 0; i < scaled.values.size(); ++i)
        scaled.values[i] = glm::vec3(set.derivatives.values[i] / set.range, 0);
    return signed_texture(formats[static_cast<std::size_t>(storage)], std::move(scaled), 2,
                          storage == WrinkleStorage::half_float);
}

/// Differences need three channels, which RGTC has not (8.2.1): plain bytes, or half floats.
gl::Texture difference_texture(const Map<glm::vec3>& map, WrinkleStorage storage) {
    const bool floats = storage == WrinkleStorage::half_float;
    return signed_texture(floats ? GL_RGB16F : GL_RGB8_SNORM, map, 3, floats);
}

gl::Texture mask_texture(const std::vector<ScalarMap>& masks, std::size_t first) {
    const std::uint32_t width = masks[0].width, height = masks[0].height;
    std::vector<std::uint8_t> bytes(std::size_t{width} * height * 4, 0);
    for (std::size_t c = 0; c < 4 && first + c < masks.size(); ++c) {
        for (std::size_t i = 0; i < masks[first + c].values.size(); ++i)
            bytes[4 * i + c] = static_cast<std::uint8_t>(masks[first + c].values[i] * 255.0F + 0.5F);
    }
    gl::Texture texture = texture_2d(GL_RGBA8, width, height);
    upload(texture, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
    return texture;
}

/// The base normal map of the skin, or one without texels.
NormalMap base_normals(const CharacterState& state) {
    NormalMap base;
    for (std::size_t m = 0; m < state.face.materials.size(); ++m) {
        const Material& material = state.face.materials[m];
        if (!state.skin_material[m] || material.normal.image < 0) continue;
        const Image& image = state.face.images[static_cast<std::size_t>(material.normal.image)];
        if (image.channels < 3) continue;
        base = NormalMap(image.width, image.height);
        for (std::size_t i = 0; i < base.values.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t k = i * image.channels + c;
                const float stored = image.bytes.empty() ? image.floats[k] : static_cast<float>(image.bytes[k]) / 255;
                base.values[i][static_cast<glm::length_t>(c)] = 2 * stored - 1;
            }
            base.values[i].x *= material.normal_scale;
            base.values[i].y *= material.normal_scale;
        }
        return base;
    }
    return base;
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

WrinkleTextures& wrinkle_textures(CharacterState& state) {
    WrinkleTextures& textures = state.own<WrinkleTextures>();
    const WrinkleSet& set = *state.appearance.wrinkles;
    const auto storage = static_cast<WrinkleStorage>(state.settings.choice(wrinkles_effect.name, "storage"));
    const bool differences = state.settings.choice(wrinkles_effect.name, "encoding") == 1;
    if (!textures.masks[0]) {
        for (std::size_t m = 0; m < 2; ++m) textures.masks[m] = mask_texture(set.masks, 4 * m);
    }
    if (textures.storage != storage) {
        textures.derivatives = {};
        textures.differences = {};
        textures.storage = storage;
    }
    if (!differences && !textures.derivatives) textures.derivatives = derivative_texture(set, storage);
    if (differences && !textures.differences)
        textures.differences = difference_texture(normal_differences(set.derivatives, base_normals(state)), storage);

    const std::uint64_t map_texels = set.derivatives.values.size(), mask_texels = set.masks[0].values.size();
    constexpr std::array<std::uint64_t, 3> derivative_bytes = {1, 2, 4}, difference_bytes = {3, 3, 6};
    const auto& a_texel = differences ? difference_bytes : derivative_bytes;
    textures.bytes = map_texels * a_texel[static_cast<std::size_t>(storage)] + 2 * 4 * mask_texels;
    return textures;
}

BloodTextures& blood_textures(CharacterState& state) {
    BloodTextures& textures = state.own<BloodTextures>();
    if (textures.pigments) return textures;
    const SkinPigments& pigments = *state.appearance.pigments;
    const std::uint32_t width = pigments.maps.skin.width, height = pigments.maps.skin.height;
    const int levels = levels_of(width, height);
    textures.pigments = texture_2d(GL_RGBA8, width, height, levels);
    upload(textures.pigments, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pigment_texels(pigments.maps));
    glGenerateTextureMipmap(textures.pigments.name());

    const SkinColourTable table;
    textures.table = texture_2d(GL_RGB16F, table.melanin_nodes(), table.hemoglobin_nodes());
    upload(textures.table, table.melanin_nodes(), table.hemoglobin_nodes(), GL_RGB, GL_FLOAT,
           std::vector<glm::vec3>(table.texels().begin(), table.texels().end()));
    glTextureParameteri(textures.table.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(textures.table.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

    const HemoglobinMaps& blood = pigments.blood;
    for (const std::string& name : state.rig.hemoglobin_maps()) {
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
    textures.blended = texture_2d(GL_RG16F, change_width, change_height);
    textures.blend_framebuffer = gl::make_framebuffer();
    glNamedFramebufferTexture(textures.blend_framebuffer.name(), GL_COLOR_ATTACHMENT0, textures.blended.name(), 0);
    Result<gl::Program> program = gl::make_program({"screen.vert", "blood_change.frag"});
    assert(program && "blood_change.frag does not compile");
    if (program) textures.blend_program = *std::move(program);
    return textures;
}

void blend_blood(CharacterState& state) {
    BloodTextures& textures = blood_textures(state);
    std::array<glm::ivec4, BLUSH_MOST_BLOOD_MAPS / 4> layers{};
    std::array<glm::vec4, BLUSH_MOST_BLOOD_MAPS / 4> shares{};
    int count = 0;
    for (std::size_t m = 0; m < state.pose.hemoglobin.size() && count < BLUSH_MOST_BLOOD_MAPS; ++m) {
        if (state.pose.hemoglobin[m] == 0 || textures.layer[m] < 0) continue;
        const auto slot = static_cast<std::size_t>(count);
        layers[slot / 4][static_cast<glm::length_t>(slot % 4)] = textures.layer[m];
        shares[slot / 4][static_cast<glm::length_t>(slot % 4)] = state.pose.hemoglobin[m];
        ++count;
    }
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(textures.blended.name(), 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(textures.blended.name(), 0, GL_TEXTURE_HEIGHT, &height);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, textures.blend_framebuffer.name());
    glViewport(0, 0, width, height);
    glUseProgram(textures.blend_program.name());
    glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, textures.changes.name());
    glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
    glUniform1i(0, count);
    glUniform4iv(1, static_cast<GLsizei>(layers.size()), &layers[0].x);
    glUniform4fv(1 + BLUSH_MOST_BLOOD_MAPS / 4, static_cast<GLsizei>(shares.size()), &shares[0].x);
    glBindVertexArray(state.no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    textures.blended_shares = state.pose.hemoglobin;
}

void bind_appearance(CharacterState& state, bool wrinkles, bool blood) {
    if (!wrinkles && !blood) return;
    shared::AppearanceBlock block{};
    if (wrinkles) {
        const WrinkleTextures& textures = wrinkle_textures(state);
        const WrinkleSet& set = *state.appearance.wrinkles;
        const std::span<const std::string> zones = state.rig.wrinkle_zones();
        for (std::size_t z = 0; z < set.zones.size(); ++z) {
            const auto found = std::ranges::find(zones, set.zones[z]);
            if (found == zones.end()) continue;
            block.wrinkle_weights[z / 4][static_cast<glm::length_t>(z % 4)] =
                state.pose.wrinkles[static_cast<std::size_t>(found - zones.begin())];
        }
        block.wrinkle_range.x = set.range;
        const bool differences = state.settings.choice(wrinkles_effect.name, "encoding") == 1;
        glBindTextureUnit(BLUSH_WRINKLE_MAP_UNIT, (differences ? textures.differences : textures.derivatives).name());
        glBindTextureUnit(BLUSH_WRINKLE_MASK_1_UNIT, textures.masks[0].name());
        glBindTextureUnit(BLUSH_WRINKLE_MASK_2_UNIT, textures.masks[1].name());
    }
    if (blood) {
        const BloodTextures& textures = blood_textures(state);
        block.blood = {state.pose.hemoglobin_factor, static_cast<float>(largest_hemoglobin), 0, 0};
        glBindTextureUnit(BLUSH_PIGMENT_UNIT, textures.pigments.name());
        glBindTextureUnit(BLUSH_BLOOD_CHANGE_UNIT, textures.blended.name());
        glBindTextureUnit(BLUSH_SKIN_COLOR_UNIT, textures.table.name());
    }
    for (GLuint unit = BLUSH_WRINKLE_MAP_UNIT; unit <= BLUSH_SKIN_COLOR_UNIT; ++unit) glBindSampler(unit, 0);
    auto& buffer = state.own<AppearanceBuffer>().buffer;
    if (!buffer) buffer = gl::make_buffer(sizeof(block), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(buffer.name(), 0, sizeof(block), &block);
    glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_APPEARANCE_BINDING, buffer.name());
}

}  // namespace blush
