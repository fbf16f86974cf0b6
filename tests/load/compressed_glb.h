#pragma once
/// Compressed variants of the files that GlbBuilder makes, through the encoders of meshoptimizer and Draco.

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include "tests/gltf_builder.h"

namespace blush::test {

/// Replaces the bytes of one accessor's bufferView (tightly packed, `stride` bytes an element) by a meshopt stream.
inline void compress_view(GlbBuilder& glb, std::size_t accessor, std::size_t stride, const std::string& mode,
                          const std::string& filter = "NONE") {
    nlohmann::json& view = glb.json["bufferViews"][glb.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    const std::size_t length = view["byteLength"].get<std::size_t>();
    const std::size_t count = length / stride;
    const std::uint8_t* source = glb.bin.data() + view["byteOffset"].get<std::size_t>();
    std::vector<std::uint8_t> encoded;
    if (mode == "ATTRIBUTES") {
        meshopt_encodeVertexVersion(0);
        encoded.resize(meshopt_encodeVertexBufferBound(count, stride));
        encoded.resize(meshopt_encodeVertexBuffer(encoded.data(), encoded.size(), source, count, stride));
    } else {
        std::vector<unsigned int> indices(count);
        std::memcpy(indices.data(), source, length);
        if (mode == "TRIANGLES") {
            meshopt_encodeIndexVersion(1);
            encoded.resize(meshopt_encodeIndexBufferBound(count, 1U << 16));
            encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices.data(), count));
        } else {
            meshopt_encodeIndexVersion(1);
            encoded.resize(meshopt_encodeIndexSequenceBound(count, 1U << 16));
            encoded.resize(meshopt_encodeIndexSequence(encoded.data(), encoded.size(), indices.data(), count));
        }
    }
    const std::size_t stored = glb.view(std::as_bytes(std::span(encoded)));
    nlohmann::json& decoded = glb.json["bufferViews"][glb.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
    nlohmann::json extension = {{"buffer", 0},
                                {"byteOffset", glb.json["bufferViews"][stored]["byteOffset"]},
                                {"byteLength", encoded.size()},
                                {"byteStride", stride},
                                {"count", count},
                                {"mode", mode}};
    if (filter != "NONE") extension["filter"] = filter;
    decoded["buffer"] = 1;
    decoded["byteOffset"] = 0;
    decoded["extensions"]["EXT_meshopt_compression"] = extension;
    glb.json["buffers"] = {
        {{"byteLength", glb.bin.size()}},
        {{"byteLength", 1'000'000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    glb.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
}

/// A flat fan of `triangles` triangles around the origin, POSITION compressed by Draco.
inline GlbBuilder draco_fan(std::uint32_t triangles) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(triangles));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const auto corner = [&](std::uint32_t i) {
        const float angle_radians = 6.2831853F * static_cast<float>(i) / static_cast<float>(triangles);
        return glm::vec3(std::cos(angle_radians), std::sin(angle_radians), 0);
    };
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::vec3 a(0), b = corner(i), c = corner((i + 1) % triangles);
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(i), &a, &b, &c);
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    draco::EncoderBuffer buffer;
    if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) return {};
    GlbBuilder glb;
    glb.surface(
        std::vector<glm::vec3>(encoder.num_encoded_points() == 0 ? mesh->num_points() : encoder.num_encoded_points()),
        std::vector<std::uint32_t>(3 * triangles));
    for (nlohmann::json& accessor : glb.json["accessors"]) accessor.erase("bufferView");
    glb.bin.clear();
    glb.json["bufferViews"].clear();
    const std::size_t view = glb.view(std::as_bytes(std::span(buffer.data(), buffer.size())));
    const auto id = mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION)->unique_id();
    glb.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                   {"attributes", {{"POSITION", id}}}};
    glb.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return glb;
}

}  // namespace blush::test
