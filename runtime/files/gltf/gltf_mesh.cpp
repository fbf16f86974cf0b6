#include "runtime/files/gltf/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_accessor.h"
#include "runtime/files/gltf/gltf_draco.h"
#include "runtime/files/gltf/gltf_targets.h"
#include "runtime/files/gltf/missing_attributes.h"

namespace blush::load {
namespace {

using nlohmann::json;

const json* draco_extension(const json& primitive) {
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end()) return nullptr;
    const auto found = extensions->find("KHR_draco_mesh_compression");
    return found == extensions->end() ? nullptr : &*found;
}

/// One primitive of the file while it is read: attributes come from accessors or from Draco.
class PrimitiveReader {
public:
    PrimitiveReader(GltfDocument& document, std::size_t mesh, std::size_t primitive)
        : document_(document),
          source_(document.model.meshes[mesh].primitives[primitive]),
          place_(at("meshes", mesh) + "." + at("primitives", primitive)) {
        if (const json* extension = draco_extension(document.json["meshes"][mesh]["primitives"][primitive])) {
            draco_ = decode_draco(document, source_, *extension, place_ + ".extensions.KHR_draco_mesh_compression");
        }
    }

    const tinygltf::Primitive& source() const { return source_; }
    /// Draco always decodes to a list.
    int mode() const { return draco_ ? TINYGLTF_MODE_TRIANGLES : source_.mode; }
    const std::string& place() const { return place_; }
    bool has(const std::string& attribute) const { return source_.attributes.contains(attribute); }
    std::size_t accessor(const std::string& attribute) const {
        return static_cast<std::size_t>(source_.attributes.at(attribute));
    }
    std::string place_of(const std::string& attribute) const { return place_ + ".attributes." + attribute; }

    std::vector<float> floats(const std::string& attribute, int components, std::optional<std::size_t> count) {
        if (draco_) {
            if (const auto found = draco_->attributes.find(attribute); found != draco_->attributes.end()) {
                const std::size_t wanted =
                    static_cast<std::size_t>(components) * element_count(document_, accessor(attribute));
                if (found->second.size() != wanted ||
                    (count && wanted != *count * static_cast<std::size_t>(components))) {
                    refuse(place_of(attribute),
                           "the compressed attribute has another number of components or vertices");
                }
                return std::move(found->second);
            }
        }
        return read_floats(document_, {accessor(attribute), place_of(attribute), components, count});
    }

    std::vector<std::uint32_t> joints(std::size_t count) {
        if (draco_ && draco_->attributes.contains("JOINTS_0")) {
            const std::vector<float> numbers = floats("JOINTS_0", 4, count);
            std::vector<std::uint32_t> whole(numbers.size());
            std::ranges::transform(numbers, whole.begin(), [](float x) {
                return x >= 0 && x < 65536.0F ? static_cast<std::uint32_t>(x) : 65535U;
            });
            return whole;
        }
        return read_unsigned(document_, {accessor("JOINTS_0"), place_of("JOINTS_0"), 4, count});
    }

    /// The index list as the file has it, all below `vertex_count`; 0, 1, 2... where it has none.
    std::vector<std::uint32_t> raw_indices(std::size_t vertex_count) {
        if (draco_) return std::move(draco_->triangles);
        std::vector<std::uint32_t> indices;
        if (source_.indices < 0) {
            document_.spend(vertex_count, place_);
            indices.resize(vertex_count);
            for (std::size_t i = 0; i < vertex_count; ++i) indices[i] = static_cast<std::uint32_t>(i);
            return indices;
        }
        const std::string place = place_ + ".indices";
        indices = read_unsigned(document_, {static_cast<std::size_t>(source_.indices), place, 1, {}});
        for (std::size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] >= vertex_count) {
                refuse(place, "index " + std::to_string(i) + " is " + std::to_string(indices[i]) +
                                  ", but the primitive has " + std::to_string(vertex_count) + " vertices");
            }
        }
        return indices;
    }

private:
    GltfDocument& document_;
    const tinygltf::Primitive& source_;
    std::string place_;
    std::optional<DracoGeometry> draco_;
};

/// Strips and fans become lists (glTF 2.0, 3.7.2.1).
std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> indices, int mode, const std::string& place) {
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (indices.size() % 3 != 0) refuse(place, std::to_string(indices.size()) + " indices do not make triangles");
        return indices;
    }
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
        } else {
            list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
        }
    }
    return list;
}

void read_indices(GltfDocument& document, PrimitiveReader& reader, Primitive& primitive, Face& face) {
    primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
    const int mode = reader.mode();
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        if (mode < 0 || mode > TINYGLTF_MODE_TRIANGLE_FAN)
            refuse(reader.place() + ".mode", std::to_string(mode) + " is not a mode of glTF");
        document.notes.push_back(reader.place() + ": points and lines are not drawn");
        return;
    }
    const auto list = triangle_list(reader.raw_indices(primitive.vertex_count), mode, reader.place() + ".indices");
    constexpr std::size_t most_indices = std::numeric_limits<std::uint32_t>::max();
    if (list.size() > most_indices - face.indices.size()) refuse(reader.place(), "the file has too many triangles");
    face.indices.reserve(face.indices.size() + list.size());
    for (const std::uint32_t index : list) face.indices.push_back(primitive.first_vertex + index);
    primitive.index_count = static_cast<std::uint32_t>(list.size());
}

/// Unit vectors, as they are when they are near enough; those without length become zero, for
/// fill_missing_attributes().
glm::vec3 unit_or_zero(glm::vec3 v) {
    const glm::dvec3 wide(v);
    const double length = std::sqrt(glm::dot(wide, wide));
    if (std::abs(length - 1) <= static_cast<double>(unit_length_tolerance)) return v;
    return length > 0 ? glm::vec3(wide / length) : glm::vec3(0);
}

void read_normals(GltfDocument& document, PrimitiveReader& reader, Primitive& primitive, Face& face) {
    face.normals.resize(face.positions.size(), glm::vec3(0));
    if (!reader.has("NORMAL")) return;
    const std::vector<float> numbers = reader.floats("NORMAL", 3, primitive.vertex_count);
    std::size_t without_length = 0;
    for (std::size_t i = 0; i < primitive.vertex_count; ++i) {
        glm::vec3& normal = face.normals[primitive.first_vertex + i];
        normal = unit_or_zero({numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
        if (normal == glm::vec3(0)) ++without_length;
    }
    primitive.authored_normals = true;
    if (without_length > 0) {
        document.notes.push_back(reader.place_of("NORMAL") + ": " + std::to_string(without_length) +
                                 " normals have no length and were computed from the triangles");
    }
}

void read_tangents(PrimitiveReader& reader, Primitive& primitive, Face& face) {
    face.tangents.resize(face.positions.size(), glm::vec4(0));
    if (!reader.has("TANGENT")) return;
    const std::vector<float> numbers = reader.floats("TANGENT", 4, primitive.vertex_count);
    for (std::size_t i = 0; i < primitive.vertex_count; ++i) {
        const glm::vec3 direction = unit_or_zero({numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]});
        face.tangents[primitive.first_vertex + i] = glm::vec4(direction, numbers[4 * i + 3] < 0 ? -1.0F : 1.0F);
    }
    primitive.authored_tangents = true;
}

void read_uv(PrimitiveReader& reader, const std::string& attribute, const Primitive& primitive,
             std::vector<glm::vec2>& uv) {
    uv.resize(primitive.first_vertex + primitive.vertex_count, glm::vec2(0));
    if (!reader.has(attribute)) return;
    const std::vector<float> numbers = reader.floats(attribute, 2, primitive.vertex_count);
    for (std::size_t i = 0; i < primitive.vertex_count; ++i) {
        uv[primitive.first_vertex + i] = {numbers[2 * i], numbers[2 * i + 1]};
    }
}

void read_joints(GltfDocument& document, PrimitiveReader& reader, const Primitive& primitive, Face& face) {
    if (reader.has("JOINTS_1"))
        document.notes.push_back(reader.place() + ": only the first four joints of a vertex are used");
    if (reader.has("JOINTS_0") != reader.has("WEIGHTS_0")) {
        document.notes.push_back(reader.place() + ": it has only one of JOINTS_0 and WEIGHTS_0 and is not skinned");
        return;
    }
    if (!reader.has("JOINTS_0")) return;
    const std::vector<std::uint32_t> joints = reader.joints(primitive.vertex_count);
    const std::vector<float> weights = reader.floats("WEIGHTS_0", 4, primitive.vertex_count);
    face.joints.resize(face.positions.size(), glm::u16vec4(0));
    face.joint_weights.resize(face.positions.size(), glm::vec4(0));
    for (std::size_t i = 0; i < primitive.vertex_count; ++i) {
        double sum = 0;
        for (std::size_t c = 0; c < 4; ++c) sum += std::max(0.0, static_cast<double>(weights[4 * i + c]));
        for (glm::length_t c = 0; c < 4; ++c) {
            const std::size_t from = 4 * i + static_cast<std::size_t>(c);
            if (!(weights[from] > 0)) continue;
            if (joints[from] > 65'535)
                refuse(reader.place_of("JOINTS_0"), "joint " + std::to_string(joints[from]) + " is beyond 65535");
            face.joints[primitive.first_vertex + i][c] = static_cast<std::uint16_t>(joints[from]);
            face.joint_weights[primitive.first_vertex + i][c] =
                static_cast<float>(static_cast<double>(weights[from]) / sum);
        }
    }
}

void read_positions(GltfDocument& document, PrimitiveReader& reader, Primitive& primitive, Face& face) {
    primitive.first_vertex = static_cast<std::uint32_t>(face.positions.size());
    if (!reader.has("POSITION")) {
        document.notes.push_back(reader.place() + ": it has no POSITION and is not drawn");
        return;
    }
    const std::size_t count = element_count(document, reader.accessor("POSITION"));
    if (count > document.limits.vertices - face.positions.size()) {
        refuse(reader.place_of("POSITION"),
               "the file has more than " + std::to_string(document.limits.vertices) + " vertices");
    }
    const std::vector<float> numbers = reader.floats("POSITION", 3, {});
    face.positions.reserve(face.positions.size() + count);
    for (std::size_t i = 0; i < count; ++i)
        face.positions.emplace_back(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
    primitive.vertex_count = static_cast<std::uint32_t>(count);
}

Primitive read_primitive(GltfDocument& document, PrimitiveReader& reader, Face& face) {
    Primitive primitive;
    primitive.material = reader.source().material;
    read_positions(document, reader, primitive, face);
    if (reader.has("POSITION")) {
        read_indices(document, reader, primitive, face);
    } else {
        primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
        return primitive;
    }
    read_normals(document, reader, primitive, face);
    read_tangents(reader, primitive, face);
    read_uv(reader, "TEXCOORD_0", primitive, face.uv0);
    read_uv(reader, "TEXCOORD_1", primitive, face.uv1);
    read_joints(document, reader, primitive, face);
    return primitive;
}

}  // namespace

MeshTargets read_meshes(GltfDocument& document, Face& face) {
    TargetUnion targets(document, face);
    MeshTargets mesh_targets;
    for (std::size_t m = 0; m < document.model.meshes.size(); ++m) {
        const tinygltf::Mesh& source = document.model.meshes[m];
        Mesh mesh;
        mesh.name = source.name;
        mesh.first_primitive = static_cast<std::uint32_t>(face.primitives.size());
        mesh.primitive_count = static_cast<std::uint32_t>(source.primitives.size());
        mesh_targets.push_back(targets.begin_mesh(m));
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            PrimitiveReader reader(document, m, p);
            Primitive primitive = read_primitive(document, reader, face);
            primitive.mesh = static_cast<std::uint32_t>(m);
            primitive.normal_source =
                targets.add_primitive(source.primitives[p], primitive, mesh_targets.back(), reader.place());
            face.primitives.push_back(primitive);
        }
        face.meshes.push_back(std::move(mesh));
        fill_missing_attributes(face, m);
    }
    if (face.positions.empty()) refuse("", "the file has no mesh with vertices");
    if (!face.joints.empty()) {
        face.joints.resize(face.positions.size(), glm::u16vec4(0));
        face.joint_weights.resize(face.positions.size(), glm::vec4(0));
    }
    return mesh_targets;
}

}  // namespace blush::load
