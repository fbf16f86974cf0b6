#include "runtime/files/gltf/gltf_targets.h"

#include <algorithm>
#include <unordered_set>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_accessor.h"

namespace blush::load {
namespace {

std::size_t target_count(const tinygltf::Mesh& mesh) {
    std::size_t count = 0;
    for (const tinygltf::Primitive& primitive : mesh.primitives) count = std::max(count, primitive.targets.size());
    return count;
}

/// mesh.extras.targetNames, the custom of exporters that glTF 2.0 (3.7.2.2) mentions; an empty list where there is
/// none.
nlohmann::json target_names(const nlohmann::json& mesh) {
    if (mesh.contains("extras") && mesh["extras"].is_object() && mesh["extras"].contains("targetNames") &&
        mesh["extras"]["targetNames"].is_array()) {
        return mesh["extras"]["targetNames"];
    }
    return nlohmann::json::array();
}

/// Deltas of one target over one primitive, before they join the Target.
struct PrimitiveDeltas {
    SparseVectors positions, normals, tangents;
};

/// Appends the union of three ascending lists.
void append(const PrimitiveDeltas& deltas, std::uint32_t first_vertex, Target& target) {
    const SparseVectors* const lists[] = {&deltas.positions, &deltas.normals, &deltas.tangents};
    std::vector<glm::vec3>* const outputs[] = {&target.position_deltas, &target.normal_deltas, &target.tangent_deltas};
    std::size_t next[] = {0, 0, 0};
    for (std::size_t k = 1; k < 3; ++k) {
        // The first deltas of this kind: vertices from earlier primitives have none.
        if (!lists[k]->elements.empty()) outputs[k]->resize(target.vertices.size(), glm::vec3(0));
    }
    constexpr std::uint32_t end = std::numeric_limits<std::uint32_t>::max();
    while (true) {
        std::uint32_t element = end;
        for (std::size_t k = 0; k < 3; ++k) {
            if (next[k] < lists[k]->elements.size()) element = std::min(element, lists[k]->elements[next[k]]);
        }
        if (element == end) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool present = next[k] < lists[k]->elements.size() && lists[k]->elements[next[k]] == element;
            const bool kept = k == 0 || !outputs[k]->empty() || !lists[k]->elements.empty();
            if (kept) outputs[k]->push_back(present ? lists[k]->values[next[k]] : glm::vec3(0));
            if (present) ++next[k];
        }
        target.vertices.push_back(first_vertex + element);
    }
}

}  // namespace

TargetUnion::TargetUnion(GltfDocument& document, Face& face) : document_(document), face_(face) {
    first_node_of_.assign(document.model.meshes.size(), -1);
    for (std::size_t i = document.model.nodes.size(); i-- > 0;) {
        if (const int mesh = document.model.nodes[i].mesh; mesh >= 0) {
            first_node_of_[static_cast<std::size_t>(mesh)] = static_cast<std::ptrdiff_t>(i);
        }
    }
    for (const tinygltf::Mesh& mesh : document.model.meshes) {
        if (target_count(mesh) > 0) ++meshes_with_targets_;
    }
}

std::vector<std::string> TargetUnion::names_of(std::size_t mesh) {
    const tinygltf::Mesh& source = document_.model.meshes[mesh];
    const std::string mesh_place = at("meshes", mesh);
    const std::string mesh_name = source.name.empty() ? "mesh" + std::to_string(mesh) : source.name;
    const nlohmann::json listed = target_names(document_.json["meshes"][mesh]);
    std::vector<std::string> names(target_count(source));
    std::unordered_set<std::string> taken;
    std::size_t repeated = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i < listed.size() && listed[i].is_string()) names[i] = listed[i].get<std::string>();
        if (names[i].empty()) {
            names[i] = (meshes_with_targets_ > 1 ? mesh_name + "." : std::string()) + "target" + std::to_string(i);
        }
        if (!taken.insert(names[i]).second) {
            int number = 2;
            while (!taken.insert(names[i] + "#" + std::to_string(number)).second) ++number;
            names[i] += "#" + std::to_string(number);
            ++repeated;
        }
    }
    if (repeated > 0) {
        document_.notes.push_back(mesh_place + ".extras.targetNames: " + std::to_string(repeated) +
                                  " names are used twice and were numbered, as in \"name#2\"");
    }
    return names;
}

float TargetUnion::default_weight(std::size_t mesh, std::size_t target) const {
    const std::ptrdiff_t node = first_node_of_[mesh];
    const std::vector<double>* weights = &document_.model.meshes[mesh].weights;
    if (node >= 0 && !document_.model.nodes[static_cast<std::size_t>(node)].weights.empty()) {
        weights = &document_.model.nodes[static_cast<std::size_t>(node)].weights;
    }
    return target < weights->size() ? static_cast<float>((*weights)[target]) : 0.0F;
}

std::vector<std::uint32_t> TargetUnion::begin_mesh(std::size_t mesh) {
    const tinygltf::Mesh& source = document_.model.meshes[mesh];
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
        const std::size_t count = source.primitives[p].targets.size();
        if (count != 0 && count != target_count(source)) {
            refuse(at("meshes", mesh) + "." + at("primitives", p) + ".targets",
                   "it has " + std::to_string(count) + " targets, but another primitive of the mesh has " +
                       std::to_string(target_count(source)));
        }
    }
    std::vector<std::uint32_t> indices;
    const std::vector<std::string> names = names_of(mesh);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto [found, is_new] = index_of_.try_emplace(names[i], static_cast<std::uint32_t>(face_.targets.size()));
        if (is_new) {
            if (face_.targets.size() >= document_.limits.targets) {
                refuse(at("meshes", mesh),
                       "the file has more than " + std::to_string(document_.limits.targets) + " targets");
            }
            Target target;
            target.name = names[i];
            target.default_weight = default_weight(mesh, i);
            face_.targets.push_back(std::move(target));
        }
        indices.push_back(found->second);
    }
    return indices;
}

NormalSource TargetUnion::add_primitive(const tinygltf::Primitive& source, const Primitive& primitive,
                                        const std::vector<std::uint32_t>& mesh_targets, const std::string& place) {
    bool moves = false, all_authored = primitive.authored_normals;
    for (std::size_t i = 0; i < source.targets.size(); ++i) {
        const std::string target_place = place + "." + at("targets", i);
        const auto read = [&](const char* attribute) -> SparseVectors {
            const auto found = source.targets[i].find(attribute);
            if (found == source.targets[i].end()) return {};
            return read_sparse_vectors(document_, {static_cast<std::size_t>(found->second),
                                                   target_place + "." + attribute, 3, primitive.vertex_count});
        };
        const PrimitiveDeltas deltas{read("POSITION"), read("NORMAL"), read("TANGENT")};
        append(deltas, primitive.first_vertex, face_.targets[mesh_targets[i]]);
        const bool moves_positions = !deltas.positions.elements.empty();
        moves = moves || moves_positions || !deltas.normals.elements.empty() || !deltas.tangents.elements.empty();
        if (moves_positions && !source.targets[i].contains("NORMAL")) all_authored = false;
    }
    if (!moves) return NormalSource::rest;
    return all_authored ? NormalSource::authored : NormalSource::recomputed;
}

}  // namespace blush::load
