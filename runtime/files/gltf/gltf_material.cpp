#include "runtime/files/gltf/gltf_material.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/image_file.h"

namespace blush::load {
namespace {

using nlohmann::json;

// All decoded images of one file together. 2 GiB are 32 images of 4096 x 4096 pixels with 4 channels.
constexpr std::uint64_t most_pixel_bytes = std::uint64_t{2} << 30;

const json* member(const json* object, const char* name) {
    if (object == nullptr) return nullptr;
    const auto found = object->find(name);
    return found == object->end() ? nullptr : &*found;
}

float number_or(const json* object, const char* name, float otherwise) {
    const json* found = member(object, name);
    return found ? static_cast<float>(found->get<double>()) : otherwise;
}

glm::vec2 pair_or(const json* object, const char* name, glm::vec2 otherwise) {
    const json* found = member(object, name);
    return found ? glm::vec2((*found)[0].get<float>(), (*found)[1].get<float>()) : otherwise;
}

/// KHR_texture_transform: translation * rotation * scale. The rotation is counter-clockwise as seen on the image, whose
/// v grows downwards. (The matrix in the extension's first text had the other sign, against its own example.)
glm::mat3 uv_transform(const json* extension) {
    const glm::vec2 offset = pair_or(extension, "offset", glm::vec2(0)),
                    scale = pair_or(extension, "scale", glm::vec2(1));
    const float angle_radians = number_or(extension, "rotation", 0);
    const float c = std::cos(angle_radians), s = std::sin(angle_radians);
    return glm::mat3(c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1);
}

class MaterialReader {
public:
    MaterialReader(GltfDocument& document, Face& face) : document_(document), face_(face) {}

    void read(std::size_t index) {
        const tinygltf::Material& source = document_.model.materials[index];
        const json& described = document_.json["materials"][index];
        const std::string place = at("materials", index);
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name;
        for (glm::length_t c = 0; c < 4; ++c)
            material.base_color_linear[c] = unit(pbr.baseColorFactor[static_cast<std::size_t>(c)]);
        material.metallic = unit(pbr.metallicFactor);
        material.roughness = unit(pbr.roughnessFactor);
        material.normal_scale = static_cast<float>(source.normalTexture.scale);
        material.occlusion_strength = unit(source.occlusionTexture.strength);
        material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        for (glm::length_t c = 0; c < 3; ++c) {
            material.emissive_linear[c] =
                std::max(0.0F, static_cast<float>(source.emissiveFactor[static_cast<std::size_t>(c)]));
        }
        material.alpha_mode = alpha_mode(source.alphaMode, place);
        material.double_sided = source.doubleSided;
        const json* says_skin = member(member(&described, "extras"), "blush_skin");
        if (says_skin != nullptr && says_skin->is_boolean()) material.skin = says_skin->get<bool>();
        const json* by_alpha = member(member(&described, "extras"), "blush_scattering");
        material.scatter_by_alpha = material.alpha_mode == AlphaMode::opaque && by_alpha != nullptr &&
                                    by_alpha->is_string() && *by_alpha == "base_color_alpha";
        const json* specular = member(member(&described, "extensions"), "KHR_materials_specular");
        material.specular = std::clamp(number_or(specular, "specularFactor", 1), 0.0F, 1.0F);
        material.specular_map = texture_use(member(specular, "specularTexture"),
                                            place + ".extensions.KHR_materials_specular.specularTexture");
        const json* pbr_json = member(&described, "pbrMetallicRoughness");
        material.base_color_srgb =
            texture_use(member(pbr_json, "baseColorTexture"), place + ".pbrMetallicRoughness.baseColorTexture");
        material.metallic_roughness = texture_use(member(pbr_json, "metallicRoughnessTexture"),
                                                  place + ".pbrMetallicRoughness.metallicRoughnessTexture");
        material.normal = texture_use(member(&described, "normalTexture"), place + ".normalTexture");
        material.occlusion = texture_use(member(&described, "occlusionTexture"), place + ".occlusionTexture");
        material.emissive_srgb = texture_use(member(&described, "emissiveTexture"), place + ".emissiveTexture");
        face_.materials.push_back(std::move(material));
    }

private:
    /// Factors are from 0 to 1 (glTF 2.0, 5.19).
    static float unit(double x) { return static_cast<float>(std::clamp(x, 0.0, 1.0)); }

    AlphaMode alpha_mode(const std::string& name, const std::string& place) {
        if (name == "MASK") return AlphaMode::mask;
        if (name == "BLEND") return AlphaMode::blend;
        if (name != "OPAQUE")
            document_.notes.push_back(place + ".alphaMode: \"" + name + "\" is not understood and was taken as OPAQUE");
        return AlphaMode::opaque;
    }

    TextureUse texture_use(const json* info, const std::string& place) {
        TextureUse use;
        if (info == nullptr) return use;
        const auto texture_index = (*info)["index"].get<std::size_t>();
        const json& texture = document_.json["textures"][texture_index];
        const json* transform = member(member(info, "extensions"), "KHR_texture_transform");
        const json* uv_set = member(transform, "texCoord");
        if (uv_set == nullptr) uv_set = member(info, "texCoord");
        use.uv_set = uv_set ? uv_set->get<std::uint32_t>() : 0;
        if (use.uv_set > 1) {
            document_.notes.push_back(place + ": texture coordinate set " + std::to_string(use.uv_set) +
                                      " is not understood, set 0 is used");
            use.uv_set = 0;
        }
        use.uv_transform = uv_transform(transform);
        read_wrapping(texture, place, use);
        use.image = image_of(texture, at("textures", texture_index));
        return use;
    }

    void read_wrapping(const json& texture, const std::string& place, TextureUse& use) {
        if (!texture.contains("sampler")) return;
        const tinygltf::Sampler& sampler = document_.model.samplers[texture["sampler"].get<std::size_t>()];
        use.repeat_u = sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        use.repeat_v = sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        if (sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ||
            sampler.wrapT == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) {
            document_.notes.push_back(place + ": mirrored repetition is drawn as plain repetition");
        }
    }

    std::int32_t image_of(const json& texture, const std::string& place) {
        const json* source = member(&texture, "source");
        if (source == nullptr) {
            const bool is_basis = member(member(&texture, "extensions"), "KHR_texture_basisu") != nullptr;
            document_.notes.push_back(
                place +
                (is_basis ? ": KHR_texture_basisu images cannot be decoded here, the material's factor is used instead"
                          : ": it has no image that can be decoded here, the material's factor is used instead"));
            return -1;
        }
        const auto index = source->get<std::size_t>();
        const auto [found, is_new] = image_index_of_.try_emplace(index, -1);
        if (is_new) found->second = load_image(index);
        return found->second;
    }

    std::int32_t load_image(std::size_t index) {
        const json& source = document_.json["images"][index];
        const std::string place = at("images", index);
        Bytes owned;
        ByteView encoded;
        if (const json* uri = member(&source, "uri")) {
            owned = read_uri(uri->get_ref<const std::string&>(), document_.path, document_.limits.file_bytes,
                             place + ".uri");
            encoded = owned;
        } else if (const json* view = member(&source, "bufferView")) {
            encoded = document_.buffers.view(view->get<std::size_t>());
        } else {
            refuse(place, "it has neither uri nor bufferView");
        }
        if (is_ktx2(encoded)) {
            document_.notes.push_back(place +
                                      ": KTX 2 images cannot be decoded here, the material's factor is used instead");
            return -1;
        }
        Image image = decode_image(encoded, document_.limits.image_side_pixels, pixel_bytes_left_, place);
        image.name = source.value(
            "name", source.value("uri", std::string()).starts_with("data:") ? "" : source.value("uri", ""));
        face_.images.push_back(std::move(image));
        return static_cast<std::int32_t>(face_.images.size()) - 1;
    }

    GltfDocument& document_;
    Face& face_;
    std::map<std::size_t, std::int32_t> image_index_of_;
    std::uint64_t pixel_bytes_left_ = most_pixel_bytes;
};

}  // namespace

void read_materials(GltfDocument& document, Face& face) {
    MaterialReader reader(document, face);
    for (std::size_t i = 0; i < document.model.materials.size(); ++i) reader.read(i);
}

}  // namespace blush::load
