#include "runtime/draw/face_model.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/appearance/signed_texture.h"
#include "runtime/frame/device_state.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// Stride of blocks of `bytes` in one buffer, as the driver wants uniform blocks aligned.
std::size_t block_stride(std::size_t bytes) {
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    const auto step = static_cast<std::size_t>(alignment);
    return (bytes + step - 1) / step * step;
}

template <class Value>
std::vector<Value> four_channels(const std::vector<Value>& values, std::uint32_t channels, Value opaque) {
    const std::size_t pixels = values.size() / channels;
    std::vector<Value> rgba(pixels * 4, opaque);
    for (std::size_t p = 0; p < pixels; ++p) {
        const Value* in = &values[p * channels];
        Value* out = &rgba[p * 4];
        const bool grey = channels <= 2;
        for (std::uint32_t c = 0; c < 3; ++c) out[c] = grey ? in[0] : in[c];
        if (channels == 2) out[3] = in[1];
        if (channels == 4) out[3] = in[3];
    }
    return rgba;
}

float linear_from_srgb(float v) {  // IEC 61966-2-1
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

Status check_side(const Image& image, int largest_side) {
    if (image.width > static_cast<std::uint32_t>(largest_side) ||
        image.height > static_cast<std::uint32_t>(largest_side)) {
        return Error{"image \"" + image.name + "\" is " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + " pixels; this device takes " + std::to_string(largest_side)};
    }
    return Done{};
}

gl::Texture make_image_texture(const Image& image, bool srgb) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    const auto width = static_cast<GLsizei>(image.width), height = static_cast<GLsizei>(image.height);
    const int levels = 1 + static_cast<int>(std::floor(std::log2(std::max({width, height, 1}))));
    const bool bytes = !image.bytes.empty();
    const GLenum format = !bytes ? GL_RGBA16F : srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
    glTextureStorage2D(texture.name(), levels, format, width, height);
    if (bytes) {
        const auto rgba = four_channels(image.bytes, image.channels, std::uint8_t{255});
        glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    } else {
        auto rgba = four_channels(image.floats, image.channels, 1.0F);
        for (std::size_t i = 0; srgb && i < rgba.size(); ++i) {
            if (i % 4 != 3) rgba[i] = linear_from_srgb(rgba[i]);
        }
        glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
    }
    glGenerateTextureMipmap(texture.name());
    return texture;
}

/// In the order of MaterialBlock.
constexpr std::size_t texture_count = 6;
constexpr std::array<bool, texture_count> texture_is_srgb = {true, false, false, false, true, false};
constexpr std::array<const char*, texture_count> define_of_texture = {
    "BASE_COLOR_MAP", "METALLIC_ROUGHNESS_MAP", "NORMAL_MAP", "OCCLUSION_MAP", "EMISSIVE_MAP", "SPECULAR_MAP"};

std::array<const TextureUse*, texture_count> textures_of(const Material& m) {
    return {&m.base_color_srgb, &m.metallic_roughness, &m.normal, &m.occlusion, &m.emissive_srgb, &m.specular_map};
}

/// The normal map among textures_of().
constexpr std::size_t normal_texture = 2;

/// normal_range: derivative that the 1 of its base normal map stands for.
shared::MaterialBlock block_of(const Material& m, float normal_range) {
    shared::MaterialBlock block{};
    block.base_color_linear = m.base_color_linear;
    block.emissive_linear = glm::vec4(m.emissive_linear, 0);
    block.metallic_roughness_normal_occlusion = glm::vec4(m.metallic, m.roughness, m.normal_scale * normal_range,
                                                          m.occlusion.image >= 0 ? m.occlusion_strength : 0);
    block.alpha = glm::vec4(m.alpha_mode == AlphaMode::mask ? m.alpha_cutoff : -1.0F,
                            m.alpha_mode == AlphaMode::blend ? 0 : 1, m.scatter_by_alpha ? 1 : 0, m.specular);
    const auto uses = textures_of(m);
    for (std::size_t t = 0; t < uses.size(); ++t) {
        const glm::mat3 rows = glm::transpose(uses[t]->uv_transform);
        block.uv_rows[2 * t] = glm::vec4(rows[0], 0);
        block.uv_rows[2 * t + 1] = glm::vec4(rows[1], 0);
    }
    const auto set = [&](std::size_t t) { return static_cast<int>(uses[t]->uv_set); };
    block.uv_sets = glm::ivec4(set(0), set(1), set(2), set(3));
    block.emissive_uv_set = glm::ivec4(set(4), set(5), 0, 0);
    return block;
}

Material default_material() {
    Material material;
    material.metallic = 0;  // glTF's default of 1 is a mirror without surroundings: black
    return material;
}

}  // namespace

Result<std::shared_ptr<FaceModel>> FaceModel::create(const Device& device, const FaceAsset& asset) {
    const std::shared_ptr<FaceModel> model = on_device(new FaceModel(device, asset));
    if (Status built = model->build(); !built) return built.error();
    return model;
}

Status FaceModel::build() {
    const Face& face = asset.face();
    const int largest_texture_side_texels = device.info().largest_texture_side_texels;
    Result<std::shared_ptr<DeformModel>> deforms = DeformModel::create(device, face);
    if (!deforms) return deforms.error();
    deform = *std::move(deforms);
    indices = gl::make_buffer<std::uint32_t>(face.indices);
    uv0 = gl::make_buffer<glm::vec2>(face.uv0);
    uv1 = gl::make_buffer<glm::vec2>(face.uv1);

    vertex_array = gl::make_vertex_array();
    const GLuint array = vertex_array.name();
    const auto attribute = [array](GLuint location, GLint components) {
        glEnableVertexArrayAttrib(array, location);
        glVertexArrayAttribFormat(array, location, components, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(array, location, location);
    };
    attribute(BLUSH_POSITION_ATTRIBUTE, 3);
    attribute(BLUSH_NORMAL_ATTRIBUTE, 3);
    attribute(BLUSH_TANGENT_ATTRIBUTE, 4);
    attribute(BLUSH_UV0_ATTRIBUTE, 2);
    attribute(BLUSH_UV1_ATTRIBUTE, 2);
    glVertexArrayVertexBuffer(array, BLUSH_UV0_ATTRIBUTE, uv0.name(), 0, sizeof(glm::vec2));
    glVertexArrayVertexBuffer(array, BLUSH_UV1_ATTRIBUTE, uv1.name(), 0, sizeof(glm::vec2));
    glVertexArrayElementBuffer(array, indices.name());

    // An image may stand in the place of a colour, of numbers and of normals: each has a texture of its own.
    srgb_textures.resize(face.images.size());
    linear_textures.resize(face.images.size());
    normal_textures.resize(face.images.size());
    std::vector<float> normal_ranges(face.images.size(), 1);
    for (const Material& material : face.materials) {
        const auto uses = textures_of(material);
        for (std::size_t t = 0; t < uses.size(); ++t) {
            if (uses[t]->image < 0) continue;
            const auto image = static_cast<std::size_t>(uses[t]->image);
            gl::Texture& slot = (t == normal_texture  ? normal_textures
                                 : texture_is_srgb[t] ? srgb_textures
                                                      : linear_textures)[image];
            if (slot) continue;
            if (Status fits = check_side(face.images[image], largest_texture_side_texels); !fits)
                return Error{face.path + ": " + fits.error().message};
            if (t == normal_texture) {
                BaseNormalTexture made = make_base_normal_texture(face.images[image]);
                slot = std::move(made.texture);
                normal_ranges[image] = made.range;
            } else {
                slot = make_image_texture(face.images[image], texture_is_srgb[t]);
            }
        }
    }

    material_stride = block_stride(sizeof(shared::MaterialBlock));
    std::vector<std::byte> blocks(material_stride * (face.materials.size() + 1));
    const auto write_material = [&](std::size_t index, const Material& material) {
        const std::int32_t image = material.normal.image;
        const shared::MaterialBlock block =
            block_of(material, image < 0 ? 1.0F : normal_ranges[static_cast<std::size_t>(image)]);
        std::memcpy(&blocks[index * material_stride], &block, sizeof(block));
    };
    for (std::size_t m = 0; m < face.materials.size(); ++m) write_material(m, face.materials[m]);
    write_material(face.materials.size(), default_material());
    material_blocks = gl::make_buffer<std::byte>(blocks);

    for (std::size_t s = 0; s < samplers.size(); ++s) {
        samplers[s] = gl::make_sampler();
        const GLuint name = samplers[s].name();
        glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glSamplerParameteri(name, GL_TEXTURE_WRAP_S, (s & 1) != 0 ? GL_REPEAT : GL_CLAMP_TO_EDGE);
        glSamplerParameteri(name, GL_TEXTURE_WRAP_T, (s & 2) != 0 ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    }
    return Done{};
}

const std::vector<gl::Texture>& FaceModel::textures_for(std::size_t use) const {
    return use == normal_texture ? normal_textures : texture_is_srgb[use] ? srgb_textures : linear_textures;
}

void FaceModel::bind_surface(const SurfaceBuffers& surface) const {
    const GLuint array = vertex_array.name();
    glVertexArrayVertexBuffer(array, BLUSH_POSITION_ATTRIBUTE, surface.positions.name(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(array, BLUSH_NORMAL_ATTRIBUTE, surface.normals.name(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(array, BLUSH_TANGENT_ATTRIBUTE, surface.tangents.name(), 0, sizeof(glm::vec4));
    glBindVertexArray(array);
}

void FaceModel::bind_maps(std::int32_t material, std::uint32_t textures) const {
    const Face& face = asset.face();
    const std::size_t index = material >= 0 ? static_cast<std::size_t>(material) : face.materials.size();
    glBindBufferRange(GL_UNIFORM_BUFFER, BLUSH_MATERIAL_BINDING, material_blocks.name(),
                      static_cast<GLintptr>(index * material_stride), sizeof(shared::MaterialBlock));
    if (material < 0) return;
    const auto uses = textures_of(face.materials[index]);
    GLuint unit = 0;
    for (std::size_t t = 0; t < uses.size(); ++t) {
        if ((textures >> t & 1U) == 0) continue;
        const TextureUse& use = *uses[t];
        glBindTextureUnit(unit, textures_for(t)[static_cast<std::size_t>(use.image)].name());
        glBindSampler(unit, samplers[(use.repeat_u ? 1U : 0U) + (use.repeat_v ? 2U : 0U)].name());
        ++unit;
    }
}

DrawBlocks DrawBlocks::create(std::size_t count) {
    DrawBlocks blocks;
    blocks.stride = block_stride(sizeof(shared::DrawBlock));
    blocks.staging.resize(blocks.stride * count);
    blocks.buffer = gl::make_buffer(blocks.staging.size(), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return blocks;
}

void DrawBlocks::bind(std::size_t index) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, BLUSH_DRAW_BINDING, buffer.name(), static_cast<GLintptr>(index * stride),
                      sizeof(shared::DrawBlock));
}

std::uint32_t material_textures(const Face& face, std::int32_t material) {
    std::uint32_t textures = 0;
    if (material < 0) return textures;
    const auto uses = textures_of(face.materials[static_cast<std::size_t>(material)]);
    for (std::size_t t = 0; t < uses.size(); ++t) textures |= uses[t]->image >= 0 ? 1U << t : 0U;
    return textures;
}

void material_defines(std::uint32_t textures, std::vector<std::string>& out) {
    std::size_t unit = 0;
    for (std::size_t t = 0; t < texture_count; ++t) {
        if ((textures >> t & 1U) != 0) out.push_back(std::string(define_of_texture[t]) + " " + std::to_string(unit++));
    }
}

}  // namespace blush
