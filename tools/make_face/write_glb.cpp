#include "tools/make_face/write_glb.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "runtime/files/gltf/glb_writer.h"

namespace blush::make_face {
namespace {

constexpr double metres_from_mm = 0.001;
constexpr double least_delta_mm = 0.0005, least_normal_delta = 0.002;

std::int32_t add_image(const std::string& name, const std::vector<unsigned char>& png,
                       std::vector<load::PackedImage>& images) {
    if (png.empty()) return -1;
    images.push_back({name, "image/png", png});
    return static_cast<std::int32_t>(images.size() - 1);
}

Material material_of(const MaterialPart& part, std::vector<load::PackedImage>& images) {
    Material material;
    material.name = part.name;
    for (glm::length_t c = 0; c < 4; ++c)
        material.base_color_linear[c] = static_cast<float>(part.base_color_linear[static_cast<std::size_t>(c)]);
    material.metallic = 0;
    material.roughness = static_cast<float>(part.roughness);
    material.double_sided = part.double_sided;
    material.alpha_mode = part.blended ? AlphaMode::blend : AlphaMode::opaque;
    material.normal_scale = static_cast<float>(part.normal_scale);
    material.base_color_srgb.image = add_image(part.name + "Color", part.base_color_png, images);
    material.normal.image = add_image(part.name + "Normal", part.normal_png, images);
    material.metallic_roughness.image = add_image(part.name + "Roughness", part.roughness_png, images);
    material.specular_map.image = add_image(part.name + "Specular", part.specular_png, images);
    if (part.occluded) material.occlusion.image = material.metallic_roughness.image;
    return material;
}

/// Appends to the face's target of that name what moves.
void add_target(const ShapeTarget& shape, std::uint32_t first_vertex, Face& face) {
    auto target = std::ranges::find(face.targets, shape.name, &Target::name);
    if (target == face.targets.end()) {
        face.targets.emplace_back().name = shape.name;
        target = face.targets.end() - 1;
    }
    for (std::size_t v = 0; v < shape.position_deltas.size(); ++v) {
        const bool moves = glm::length(shape.position_deltas[v]) >= least_delta_mm;
        const bool turns = glm::length(shape.normal_deltas[v]) >= least_normal_delta;
        if (!moves && !turns) continue;
        target->vertices.push_back(first_vertex + static_cast<std::uint32_t>(v));
        target->position_deltas.push_back(moves ? glm::vec3(shape.position_deltas[v] * metres_from_mm) : glm::vec3(0));
        target->normal_deltas.push_back(turns ? glm::vec3(shape.normal_deltas[v]) : glm::vec3(0));
    }
}

void add_mesh(const MeshPart& part, Face& face) {
    Primitive primitive;
    primitive.mesh = static_cast<std::uint32_t>(face.meshes.size());
    primitive.material = static_cast<std::int32_t>(part.material);
    primitive.first_vertex = static_cast<std::uint32_t>(face.positions.size());
    primitive.vertex_count = static_cast<std::uint32_t>(part.mesh.positions.size());
    primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
    primitive.index_count = static_cast<std::uint32_t>(3 * part.mesh.triangles.size());
    for (const Vec3& position : part.mesh.positions) face.positions.emplace_back(position * metres_from_mm);
    face.normals.insert(face.normals.end(), part.mesh.normals.begin(), part.mesh.normals.end());
    face.uv0.insert(face.uv0.end(), part.mesh.uv.begin(), part.mesh.uv.end());
    face.uv1.resize(face.uv0.size(), glm::vec2(0));
    for (const Triangle& triangle : part.mesh.triangles) {
        for (const Index corner : triangle) face.indices.push_back(primitive.first_vertex + corner);
    }
    for (const ShapeTarget& shape : part.targets) add_target(shape, primitive.first_vertex, face);
    face.meshes.push_back({part.name, static_cast<std::uint32_t>(face.primitives.size()), 1});
    face.primitives.push_back(primitive);
}

}  // namespace

std::string glb_bytes(const FaceParts& parts) {
    Face face;
    std::vector<load::PackedImage> images;
    for (const MaterialPart& part : parts.materials) face.materials.push_back(material_of(part, images));
    for (const MeshPart& part : parts.meshes) add_mesh(part, face);
    for (const NodePart& part : parts.nodes) {
        Node& node = face.nodes.emplace_back();
        node.name = part.name;
        node.parent = face.nodes.size() > 1 ? 0 : -1;
        node.mesh = part.mesh;
        node.rest.translation = glm::vec3(part.translation_mm * metres_from_mm);
    }
    return *load::glb_bytes(face, images, "blush make_face");
}

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
