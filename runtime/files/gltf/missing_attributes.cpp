#include "runtime/files/gltf/missing_attributes.h"

#include <algorithm>
#include <span>

#include "rig/deform/rest_frame.h"

namespace blush::load {
namespace {

std::vector<std::uint32_t> rebased(std::span<const std::uint32_t> indices, std::uint32_t first_vertex) {
    std::vector<std::uint32_t> local(indices.begin(), indices.end());
    for (std::uint32_t& index : local) index -= first_vertex;
    return local;
}

void fill_normals(Face& face, std::span<const Primitive> primitives) {
    const Primitive &first = primitives.front(), &last = primitives.back();
    const std::size_t vertex_count = last.first_vertex + last.vertex_count - first.first_vertex;
    const std::span<glm::vec3> normals = std::span(face.normals).subspan(first.first_vertex, vertex_count);
    if (std::ranges::find(normals, glm::vec3(0)) == normals.end()) return;
    const std::size_t index_count = last.first_index + last.index_count - first.first_index;
    const auto triangles = rebased(std::span(face.indices).subspan(first.first_index, index_count), first.first_vertex);
    const auto computed =
        smooth_normals(std::span(face.positions).subspan(first.first_vertex, vertex_count), triangles);
    for (std::size_t i = 0; i < vertex_count; ++i) {
        if (normals[i] == glm::vec3(0)) normals[i] = computed[i];
    }
}

void fill_tangents(Face& face, const Primitive& primitive) {
    const auto part = [&](auto& all) { return std::span(all).subspan(primitive.first_vertex, primitive.vertex_count); };
    const std::span<glm::vec4> tangents = part(face.tangents);
    const auto is_missing = [](const glm::vec4& tangent) { return glm::vec3(tangent) == glm::vec3(0); };
    if (std::ranges::none_of(tangents, is_missing)) return;
    const bool second_set =
        primitive.material >= 0 && face.materials[static_cast<std::size_t>(primitive.material)].normal.uv_set == 1;
    const auto triangles =
        rebased(std::span(face.indices).subspan(primitive.first_index, primitive.index_count), primitive.first_vertex);
    const auto computed =
        tangents_from_uv(part(face.positions), part(face.normals), part(second_set ? face.uv1 : face.uv0), triangles);
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        if (is_missing(tangents[i])) tangents[i] = computed[i];
    }
}

}  // namespace

void fill_missing_attributes(Face& face, std::size_t mesh) {
    const auto primitives = std::span<const Primitive>(face.primitives)
                                .subspan(face.meshes[mesh].first_primitive, face.meshes[mesh].primitive_count);
    if (primitives.empty()) return;
    fill_normals(face, primitives);
    for (const Primitive& primitive : primitives) fill_tangents(face, primitive);
}

}  // namespace blush::load
