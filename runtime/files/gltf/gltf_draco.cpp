#include "runtime/files/gltf/gltf_draco.h"

#include <draco/compression/decode.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

/// The first members of a Draco 2.2 mesh (Draco bitstream specification, 3 and 5), read by ourselves because libdraco
/// allocates what they say before it finds out that the data is too short.
struct DracoHeader {
    std::uint64_t faces = 0, points = 0;
};

class HeaderReader {
public:
    HeaderReader(ByteView bytes, const std::string& place) : bytes_(bytes), place_(place) {}

    DracoHeader read() {
        for (const char c : {'D', 'R', 'A', 'C', 'O'}) {
            if (u8() != static_cast<std::uint8_t>(c)) refuse(place_, "the compressed bytes are not Draco's");
        }
        const int major = u8(), minor = u8();
        if (major != 2 || minor != 2) {
            refuse(place_, "Draco bitstream version " + std::to_string(major) + "." + std::to_string(minor) +
                               " is not understood, only 2.2 is");
        }
        constexpr int mesh = 1, sequential = 0, edgebreaker = 1;
        if (u8() != mesh) refuse(place_, "the Draco data is not a mesh");
        const int method = u8();
        const int flags = u8() | u8() << 8;
        constexpr int has_metadata = 0x8000;
        if ((flags & has_metadata) != 0) refuse(place_, "Draco metadata is not understood");
        DracoHeader header;
        if (method == sequential) {
            header.faces = varint();
            header.points = varint();
        } else if (method == edgebreaker) {
            u8();  // the traversal method
            header.points = varint();
            header.faces = varint();
        } else {
            refuse(place_, "the Draco encoding method " + std::to_string(method) + " is not understood");
        }
        return header;
    }

private:
    std::uint8_t u8() {
        if (next_ >= bytes_.size()) refuse(place_, "the Draco data is cut short");
        return bytes_[next_++];
    }
    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const std::uint8_t byte = u8();
            value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
            if ((byte & 0x80U) == 0) return value;
        }
        refuse(place_, "a Draco number is too long");
    }
    ByteView bytes_;
    const std::string& place_;
    std::size_t next_ = 0;
};

/// glTF keeps what an integer attribute means in its accessor.
float divisor_of(const tinygltf::Accessor& accessor) {
    if (!accessor.normalized) return 1;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return std::numeric_limits<std::int8_t>::max();
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return std::numeric_limits<std::uint8_t>::max();
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return std::numeric_limits<std::int16_t>::max();
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return std::numeric_limits<std::uint16_t>::max();
        default:
            return 1;
    }
}

std::vector<float> attribute_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                                    const tinygltf::Accessor& accessor, const std::string& place) {
    const int components = attribute.num_components();
    if (components < 1 || components > 4)
        refuse(place, "the compressed attribute has " + std::to_string(components) + " components");
    // ConvertValue() divides by itself where the attribute says that it is normalised.
    const float divisor = attribute.normalized() ? 1.0F : divisor_of(accessor);
    std::vector<float> values;
    values.reserve(std::size_t{mesh.num_points()} * static_cast<std::size_t>(components));
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute.mapped_index(point);
        float value[4] = {0, 0, 0, 0};
        if (index.value() >= attribute.size() ||
            !attribute.ConvertValue<float>(index, static_cast<std::int8_t>(components), value)) {
            refuse(place, "the compressed attribute is not valid");
        }
        for (int c = 0; c < components; ++c) {
            if (!std::isfinite(value[c]))
                refuse(place, "element " + std::to_string(point.value()) + " is not a finite number");
            // Signed normalised integers clamp at -1 (glTF 2.0, 3.11).
            values.push_back(divisor == 1 ? value[c] : std::max(value[c] / divisor, -1.0F));
        }
    }
    return values;
}

}  // namespace

DracoGeometry decode_draco(GltfDocument& document, const tinygltf::Primitive& primitive,
                           const nlohmann::json& extension, const std::string& place) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end() || primitive.indices < 0)
        refuse(place, "it needs a primitive with POSITION and indices");
    const std::size_t vertex_count = document.model.accessors[static_cast<std::size_t>(position->second)].count;
    const std::size_t index_count = document.model.accessors[static_cast<std::size_t>(primitive.indices)].count;

    const ByteView compressed = document.buffers.view(extension["bufferView"].get<std::size_t>());
    const DracoHeader header = HeaderReader(compressed, place).read();
    // Dense regular meshes come to about a bit a triangle; a header far beyond that lies.
    const std::uint64_t most_faces = 10'000 + 64 * std::uint64_t{compressed.size()};
    if (header.faces > most_faces || header.points > 3 * most_faces) {
        refuse(place,
               std::to_string(compressed.size()) + " bytes cannot hold " + std::to_string(header.faces) + " triangles");
    }
    if (header.faces * 3 != index_count) {
        refuse(place, "the Draco data has " + std::to_string(header.faces) +
                          " triangles, but the accessor of the indices says " + std::to_string(index_count) +
                          " indices");
    }
    document.spend(index_count + 16 * vertex_count, place);

    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
        refuse(place, "the compressed bytes are not valid (" + decoded.status().error_msg_string() + ")");
    const draco::Mesh& mesh = *decoded.value();
    if (std::size_t{mesh.num_faces()} * 3 != index_count || mesh.num_points() != vertex_count) {
        refuse(place, "the Draco data has " + std::to_string(mesh.num_points()) +
                          " vertices, but the accessor of POSITION says " + std::to_string(vertex_count));
    }

    DracoGeometry geometry;
    geometry.triangles.reserve(index_count);
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
        for (const draco::PointIndex& corner : mesh.face(f)) {
            if (corner.value() >= mesh.num_points()) refuse(place, "a triangle names a vertex that does not exist");
            geometry.triangles.push_back(corner.value());
        }
    }
    for (const auto& [name, id] : extension["attributes"].items()) {
        const auto listed = primitive.attributes.find(name);
        if (listed == primitive.attributes.end()) continue;
        const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id.get<std::uint32_t>());
        if (attribute == nullptr) refuse(place + ".attributes." + name, "the Draco data has no attribute " + id.dump());
        geometry.attributes[name] =
            attribute_values(mesh, *attribute, document.model.accessors[static_cast<std::size_t>(listed->second)],
                             place + ".attributes." + name);
    }
    return geometry;
}

}  // namespace blush::load
