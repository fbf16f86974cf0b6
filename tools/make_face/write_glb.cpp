#include "tools/make_face/write_glb.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>

#include <tiny_gltf.h>

namespace blush::make_face {
namespace {

constexpr double metres_from_mm = 0.001;
constexpr double least_delta_mm = 0.0005, least_normal_delta = 0.002;

class Writer {
public:
    std::string write(const FaceParts& parts) {
        model_.asset.version = "2.0";
        model_.asset.generator = "blush make_face";
        model_.buffers.resize(1);
        for (const MaterialPart& material : parts.materials) add_material(material);
        for (const MeshPart& mesh : parts.meshes) add_mesh(mesh);
        for (const NodePart& part : parts.nodes) {
            tinygltf::Node node;
            node.name = part.name;
            node.mesh = part.mesh;
            const Vec3 t = part.translation_mm * metres_from_mm;
            if (t != Vec3(0)) node.translation = {t.x, t.y, t.z};
            if (!model_.nodes.empty()) model_.nodes.front().children.push_back(static_cast<int>(model_.nodes.size()));
            model_.nodes.push_back(node);
        }
        tinygltf::Scene scene;
        scene.nodes = {0};
        model_.scenes.push_back(scene);
        model_.defaultScene = 0;

        std::ostringstream stream;
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true);
        return stream.str();
    }

private:
    template <class T>
    int add_view(const std::vector<T>& values, int target = 0) {
        auto& bytes = model_.buffers[0].data;
        bytes.resize((bytes.size() + 3) / 4 * 4);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = values.size() * sizeof(T);
        view.target = target;
        bytes.resize(bytes.size() + view.byteLength);
        std::memcpy(bytes.data() + view.byteOffset, values.data(), view.byteLength);
        model_.bufferViews.push_back(view);
        return static_cast<int>(model_.bufferViews.size() - 1);
    }

    int add_accessor(tinygltf::Accessor accessor) {
        model_.accessors.push_back(std::move(accessor));
        return static_cast<int>(model_.accessors.size() - 1);
    }

    static std::vector<glm::vec3> to_float(const std::vector<Vec3>& values, double scale) {
        std::vector<glm::vec3> result;
        result.reserve(values.size());
        for (const Vec3& v : values) result.emplace_back(v * scale);
        return result;
    }

    static void set_bounds(tinygltf::Accessor& accessor, const std::vector<glm::vec3>& values, bool with_zero) {
        glm::vec3 low(with_zero || values.empty() ? glm::vec3(0) : values[0]), high(low);
        for (const glm::vec3& v : values) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        accessor.minValues = {static_cast<double>(low.x), static_cast<double>(low.y), static_cast<double>(low.z)};
        accessor.maxValues = {static_cast<double>(high.x), static_cast<double>(high.y), static_cast<double>(high.z)};
    }

    int add_vectors(const std::vector<glm::vec3>& values, bool bounds) {
        tinygltf::Accessor accessor;
        accessor.bufferView = add_view(values, TINYGLTF_TARGET_ARRAY_BUFFER);
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = TINYGLTF_TYPE_VEC3;
        accessor.count = values.size();
        if (bounds) set_bounds(accessor, values, false);
        return add_accessor(accessor);
    }

    /// glTF 2.0, 3.6.2.3: an accessor without a buffer view is all zeros, which the sparse values then replace.
    int add_sparse(const std::vector<Vec3>& deltas, double scale, double least) {
        std::vector<std::uint32_t> indices;
        std::vector<glm::vec3> values;
        for (std::uint32_t v = 0; v < deltas.size(); ++v) {
            if (glm::length(deltas[v]) < least) continue;
            indices.push_back(v);
            values.emplace_back(deltas[v] * scale);
        }
        tinygltf::Accessor accessor;
        accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.type = TINYGLTF_TYPE_VEC3;
        accessor.count = deltas.size();
        set_bounds(accessor, values, values.size() < deltas.size());
        if (!indices.empty()) {
            accessor.sparse.isSparse = true;
            accessor.sparse.count = static_cast<int>(indices.size());
            accessor.sparse.indices.bufferView = add_view(indices);
            accessor.sparse.indices.byteOffset = 0;
            accessor.sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
            accessor.sparse.values.bufferView = add_view(values);
            accessor.sparse.values.byteOffset = 0;
        }
        return add_accessor(accessor);
    }

    int add_texture(const std::string& name, const std::vector<unsigned char>& png) {
        tinygltf::Image image;
        image.name = name;
        image.mimeType = "image/png";
        image.bufferView = add_view(png);
        model_.images.push_back(image);
        if (model_.samplers.empty()) {
            tinygltf::Sampler sampler;
            sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
            sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
            model_.samplers.push_back(sampler);
        }
        tinygltf::Texture texture;
        texture.source = static_cast<int>(model_.images.size() - 1);
        texture.sampler = 0;
        model_.textures.push_back(texture);
        return static_cast<int>(model_.textures.size() - 1);
    }

    void add_material(const MaterialPart& part) {
        tinygltf::Material material;
        material.name = part.name;
        material.pbrMetallicRoughness.baseColorFactor.assign(part.base_color_linear.begin(),
                                                             part.base_color_linear.end());
        material.pbrMetallicRoughness.metallicFactor = 0;
        material.pbrMetallicRoughness.roughnessFactor = part.roughness;
        material.doubleSided = part.double_sided;
        if (!part.base_color_png.empty())
            material.pbrMetallicRoughness.baseColorTexture.index =
                add_texture(part.name + "Color", part.base_color_png);
        if (!part.normal_png.empty()) {
            material.normalTexture.index = add_texture(part.name + "Normal", part.normal_png);
            material.normalTexture.scale = part.normal_scale;
        }
        if (!part.roughness_png.empty())
            material.pbrMetallicRoughness.metallicRoughnessTexture.index =
                add_texture(part.name + "Roughness", part.roughness_png);
        model_.materials.push_back(material);
    }

    void add_mesh(const MeshPart& part) {
        tinygltf::Mesh mesh;
        mesh.name = part.name;
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(part.material);
        primitive.attributes["POSITION"] = add_vectors(to_float(part.mesh.positions, metres_from_mm), true);
        primitive.attributes["NORMAL"] = add_vectors(to_float(part.mesh.normals, 1), false);

        std::vector<glm::vec2> uv(part.mesh.uv.begin(), part.mesh.uv.end());
        tinygltf::Accessor texture;
        texture.bufferView = add_view(uv, TINYGLTF_TARGET_ARRAY_BUFFER);
        texture.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
        texture.type = TINYGLTF_TYPE_VEC2;
        texture.count = uv.size();
        primitive.attributes["TEXCOORD_0"] = add_accessor(texture);

        std::vector<std::uint32_t> indices;
        for (const Triangle& t : part.mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
        tinygltf::Accessor index;
        index.bufferView = add_view(indices, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        index.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        index.type = TINYGLTF_TYPE_SCALAR;
        index.count = indices.size();
        primitive.indices = add_accessor(index);

        tinygltf::Value::Array names;
        for (const ShapeTarget& target : part.targets) {
            primitive.targets.push_back(
                {{"POSITION", add_sparse(target.position_deltas, metres_from_mm, least_delta_mm)},
                 {"NORMAL", add_sparse(target.normal_deltas, 1, least_normal_delta)}});
            names.emplace_back(target.name);
            mesh.weights.push_back(0);
        }
        if (!names.empty())
            mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
        mesh.primitives.push_back(primitive);
        model_.meshes.push_back(mesh);
    }

    tinygltf::Model model_;
};

}  // namespace

std::string glb_bytes(const FaceParts& parts) { return Writer().write(parts); }

namespace {
Error cannot_write(const std::filesystem::path& path, const std::string& reason) {
    return Error{path.string() + ": cannot be written: " + reason};
}
std::filesystem::path beside(const std::filesystem::path& path) {
    std::filesystem::path part = path;
    part += ".part";
    return part;
}
}  // namespace

Status check_writable(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (path.empty()) return Error{"the output path is empty"};
    if (fs::is_directory(path, error)) return cannot_write(path, "it is a folder");
    const std::ofstream file(beside(path), std::ios::binary);
    if (!file) return cannot_write(path, std::strerror(errno));
    fs::remove(beside(path), error);
    return Done{};
}

Status write_file(const std::filesystem::path& path, const std::string& bytes) {
    namespace fs = std::filesystem;
    if (Status status = check_writable(path); !status) return status;
    std::error_code error;
    std::ofstream file(beside(path), std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
        fs::remove(beside(path), error);
        return cannot_write(path, "the disk took only a part of it");
    }
    fs::rename(beside(path), path, error);
    if (!error) return Done{};
    const std::string reason = error.message();
    fs::remove(beside(path), error);
    return cannot_write(path, reason);
}

}  // namespace blush::make_face
