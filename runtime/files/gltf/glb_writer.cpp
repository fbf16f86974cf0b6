#include "runtime/files/gltf/glb_writer.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <tiny_gltf.h>

namespace blush::load {
namespace {

std::vector<double> doubles(glm::vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// Offsets into the target's own lists of what falls into a primitive.
struct Range {
    std::size_t first, end;
};

Range range_of(const Target& target, const Primitive& primitive) {
    const auto first = std::ranges::lower_bound(target.vertices, primitive.first_vertex);
    const auto end = std::ranges::lower_bound(target.vertices, primitive.first_vertex + primitive.vertex_count);
    return {static_cast<std::size_t>(first - target.vertices.begin()),
            static_cast<std::size_t>(end - target.vertices.begin())};
}

class Writer {
public:
    Writer(const Face& face, std::span<const PackedImage> images) : face_(face), images_(images) {}

    std::string write(const std::string& generator) {
        model_.asset.version = "2.0";
        model_.asset.generator = generator;
        model_.buffers.resize(1);
        for (const PackedImage& image : images_) add_image(image);
        for (const Material& material : face_.materials) add_material(material);
        for (const Mesh& mesh : face_.meshes) add_mesh(mesh);
        add_nodes();
        std::ostringstream stream;
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true);
        return stream.str();
    }

private:
    template <class T>
    int add_view(std::span<const T> values, int target = 0) {
        auto& bytes = model_.buffers[0].data;
        bytes.resize((bytes.size() + 3) / 4 * 4);  // accessors start at a multiple of their component's size
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = values.size_bytes();
        view.target = target;
        bytes.resize(bytes.size() + view.byteLength);
        if (!values.empty()) std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
        model_.bufferViews.push_back(view);
        return static_cast<int>(model_.bufferViews.size() - 1);
    }

    int add_accessor(tinygltf::Accessor accessor) {
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size() - 1);
    }

    static void set_bounds(tinygltf::Accessor& accessor, std::span<const glm::vec3> values, bool with_zero) {
        glm::vec3 low(with_zero || values.empty() ? glm::vec3(0) : values[0]), high(low);
        for (const glm::vec3& v : values) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        accessor.minValues = doubles(low);
        accessor.maxValues = doubles(high);
    }

    template <class T>
    int add_values(std::span<const T> values, int type, int component_type, int target) {
        tinygltf::Accessor accessor;
        accessor.bufferView = add_view(values, target);
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = values.size();
        if constexpr (std::is_same_v<T, glm::vec3>) set_bounds(accessor, values, false);
        return add_accessor(accessor);
    }

    /// glTF 2.0, 3.6.2.3: an accessor without a buffer view is all zeros, which the sparse values then replace.
    int add_sparse(std::span<const std::uint32_t> vertices, std::span<const glm::vec3> deltas,
                   const Primitive& primitive) {
        std::vector<std::uint32_t> indices;
        std::vector<glm::vec3> values;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (deltas[i] == glm::vec3(0)) continue;
            indices.push_back(vertices[i] - primitive.first_vertex);
            values.push_back(deltas[i]);
        }
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = TINYGLTF_TYPE_VEC3;
        accessor.count = primitive.vertex_count;
        set_bounds(accessor, values, values.size() < primitive.vertex_count);
        if (!indices.empty()) {
            accessor.sparse.isSparse = true;
            accessor.sparse.count = static_cast<int>(indices.size());
            accessor.sparse.indices.bufferView = add_view(std::span<const std::uint32_t>(indices));
            accessor.sparse.indices.byteOffset = 0;
            accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
            accessor.sparse.values.bufferView = add_view(std::span<const glm::vec3>(values));
            accessor.sparse.values.byteOffset = 0;
        }
        return add_accessor(accessor);
    }

    void add_image(const PackedImage& packed) {
        tinygltf::Image image;
        image.name = packed.name;
        image.mimeType = packed.media_type;
        image.bufferView = add_view(std::span<const std::uint8_t>(packed.bytes));
        model_.images.push_back(image);
    }

    int sampler(bool repeat_u, bool repeat_v) {
        tinygltf::Sampler wanted;
        wanted.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
        wanted.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
        wanted.wrapS = repeat_u ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        wanted.wrapT = repeat_v ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
        const auto same = [&](const tinygltf::Sampler& s) {
            return s.wrapS == wanted.wrapS && s.wrapT == wanted.wrapT;
        };
        const auto found = std::ranges::find_if(model_.samplers, same);
        const auto index = static_cast<int>(found - model_.samplers.begin());
        if (found == model_.samplers.end()) model_.samplers.push_back(wanted);
        return index;
    }

    template <class Info>
    void set_texture(Info& info, const TextureUse& use) {
        if (use.image < 0) return;
        tinygltf::Texture texture;
        texture.source = use.image;
        texture.sampler = sampler(use.repeat_u, use.repeat_v);
        model_.textures.push_back(texture);
        info.index = static_cast<int>(model_.textures.size() - 1);
        info.texCoord = static_cast<int>(use.uv_set);
    }

    void add_material(const Material& source) {
        tinygltf::Material material;
        material.name = source.name;
        tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        for (glm::length_t c = 0; c < 4; ++c)
            pbr.baseColorFactor[static_cast<std::size_t>(c)] = static_cast<double>(source.base_color_linear[c]);
        pbr.metallicFactor = static_cast<double>(source.metallic);
        pbr.roughnessFactor = static_cast<double>(source.roughness);
        set_texture(pbr.baseColorTexture, source.base_color_srgb);
        set_texture(pbr.metallicRoughnessTexture, source.metallic_roughness);
        set_texture(material.normalTexture, source.normal);
        material.normalTexture.scale = static_cast<double>(source.normal_scale);
        set_texture(material.occlusionTexture, source.occlusion);
        material.occlusionTexture.strength = static_cast<double>(source.occlusion_strength);
        set_texture(material.emissiveTexture, source.emissive_srgb);
        material.emissiveFactor = doubles(source.emissive_linear);
        if (source.alpha_mode == AlphaMode::mask) {
            material.alphaMode = "MASK";
            material.alphaCutoff = static_cast<double>(source.alpha_cutoff);
        }
        if (source.alpha_mode == AlphaMode::blend) material.alphaMode = "BLEND";
        material.doubleSided = source.double_sided;
        if (source.specular != 1 || source.specular_map.image >= 0) {
            tinygltf::Value::Object specular = {
                {"specularFactor", tinygltf::Value(static_cast<double>(source.specular))}};
            if (source.specular_map.image >= 0) {
                tinygltf::TextureInfo info;
                set_texture(info, source.specular_map);
                specular["specularTexture"] = tinygltf::Value(tinygltf::Value::Object{
                    {"index", tinygltf::Value(info.index)}, {"texCoord", tinygltf::Value(info.texCoord)}});
            }
            material.extensions["KHR_materials_specular"] = tinygltf::Value(specular);
            auto& used = model_.extensionsUsed;
            if (std::ranges::find(used, "KHR_materials_specular") == used.end())
                used.emplace_back("KHR_materials_specular");
        }
        if (source.scatter_by_alpha)
            material.extras = tinygltf::Value(
                tinygltf::Value::Object{{"blush_scattering", tinygltf::Value(std::string("base_color_alpha"))}});
        model_.materials.push_back(material);
    }

    /// Targets that move something of the mesh. The first mesh that has any lists all, so that their order, which
    /// loaders take from the file, stays the face's.
    std::vector<std::size_t> targets_of(const Mesh& mesh) {
        std::vector<std::size_t> moving;
        for (std::size_t t = 0; t < face_.targets.size(); ++t) {
            for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
                const Range range = range_of(face_.targets[t], face_.primitives[mesh.first_primitive + p]);
                if (range.first == range.end) continue;
                moving.push_back(t);
                break;
            }
        }
        if (moving.empty() || all_listed_) return moving;
        all_listed_ = true;
        moving.clear();
        for (std::size_t t = 0; t < face_.targets.size(); ++t) moving.push_back(t);
        return moving;
    }

    template <class T>
    std::span<const T> part(const std::vector<T>& all, const Primitive& primitive) const {
        return std::span(all).subspan(primitive.first_vertex, primitive.vertex_count);
    }

    void add_mesh(const Mesh& source) {
        tinygltf::Mesh mesh;
        mesh.name = source.name;
        const std::vector<std::size_t> targets = targets_of(source);
        for (std::uint32_t p = 0; p < source.primitive_count; ++p)
            mesh.primitives.push_back(primitive_of(face_.primitives[source.first_primitive + p], targets));
        tinygltf::Value::Array names;
        for (const std::size_t t : targets) {
            names.emplace_back(face_.targets[t].name);
            mesh.weights.push_back(static_cast<double>(face_.targets[t].default_weight));
        }
        if (!names.empty())
            mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
        model_.meshes.push_back(mesh);
    }

    tinygltf::Primitive primitive_of(const Primitive& source, std::span<const std::size_t> targets) {
        constexpr int vertex = TINYGLTF_TARGET_ARRAY_BUFFER, real = TINYGLTF_COMPONENT_TYPE_FLOAT;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = source.material;
        primitive.attributes["POSITION"] = add_values(part(face_.positions, source), TINYGLTF_TYPE_VEC3, real, vertex);
        primitive.attributes["NORMAL"] = add_values(part(face_.normals, source), TINYGLTF_TYPE_VEC3, real, vertex);
        primitive.attributes["TEXCOORD_0"] = add_values(part(face_.uv0, source), TINYGLTF_TYPE_VEC2, real, vertex);
        const auto second = part(face_.uv1, source);
        if (std::ranges::any_of(second, [](glm::vec2 uv) { return uv != glm::vec2(0); }))
            primitive.attributes["TEXCOORD_1"] = add_values(second, TINYGLTF_TYPE_VEC2, real, vertex);

        std::vector<std::uint32_t> indices(face_.indices.begin() + source.first_index,
                                           face_.indices.begin() + source.first_index + source.index_count);
        for (std::uint32_t& index : indices) index -= source.first_vertex;
        primitive.indices = add_values(std::span<const std::uint32_t>(indices), TINYGLTF_TYPE_SCALAR,
                                       TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);

        for (const std::size_t t : targets) {
            const Target& target = face_.targets[t];
            const Range range = range_of(target, source);
            const auto moved = [&](const auto& all) {
                return std::span(all).subspan(range.first, range.end - range.first);
            };
            std::map<std::string, int> attributes;
            attributes["POSITION"] = add_sparse(moved(target.vertices), moved(target.position_deltas), source);
            if (!target.normal_deltas.empty())
                attributes["NORMAL"] = add_sparse(moved(target.vertices), moved(target.normal_deltas), source);
            primitive.targets.push_back(std::move(attributes));
        }
        return primitive;
    }

    void add_nodes() {
        tinygltf::Scene scene;
        for (std::size_t n = 0; n < face_.nodes.size(); ++n) {
            const Node& source = face_.nodes[n];
            tinygltf::Node node;
            node.name = source.name;
            node.mesh = source.mesh;
            if (source.matrix) {
                for (glm::length_t c = 0; c < 4; ++c) {
                    for (glm::length_t r = 0; r < 4; ++r)
                        node.matrix.push_back(static_cast<double>((*source.matrix)[c][r]));
                }
            } else {
                const Transform& t = source.rest;
                const Quat& q = t.rotation;
                if (t.translation != glm::vec3(0)) node.translation = doubles(t.translation);
                if (q != Quat{})
                    node.rotation = {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z),
                                     static_cast<double>(q.w)};
                if (t.scale != glm::vec3(1)) node.scale = doubles(t.scale);
            }
            model_.nodes.push_back(node);
            auto& siblings =
                source.parent < 0 ? scene.nodes : model_.nodes[static_cast<std::size_t>(source.parent)].children;
            siblings.push_back(static_cast<int>(n));
        }
        model_.scenes.push_back(scene);
        model_.defaultScene = 0;
    }

    const Face& face_;
    std::span<const PackedImage> images_;
    tinygltf::Model model_;
    bool all_listed_ = false;
};

}  // namespace

Result<std::string> glb_bytes(const Face& face, std::span<const PackedImage> images, const std::string& generator) {
    if (!face.skins.empty() || !face.animations.empty())
        return Error{face.path + ": skins and animations cannot be written"};
    for (const Material& material : face.materials) {
        for (const TextureUse* use : {&material.base_color_srgb, &material.metallic_roughness, &material.normal,
                                      &material.occlusion, &material.emissive_srgb, &material.specular_map}) {
            if (use->image >= static_cast<std::int32_t>(images.size()))
                return Error{face.path + ": a texture of \"" + material.name + "\" has no image"};
            if (use->uv_transform != glm::mat3(1)) return Error{face.path + ": texture transforms cannot be written"};
        }
    }
    return Writer(face, images).write(generator);
}

}  // namespace blush::load
