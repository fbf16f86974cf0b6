#include "runtime/files/gltf/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <queue>
#include <set>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_accessor.h"

namespace blush::load {
namespace {

std::vector<std::int32_t> parents_of(const tinygltf::Model& model) {
    std::vector<std::int32_t> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (std::size_t c = 0; c < model.nodes[i].children.size(); ++c) {
            const auto child = static_cast<std::size_t>(model.nodes[i].children[c]);
            if (parents[child] >= 0) {
                refuse(at("nodes", i) + "." + at("children", c),
                       at("nodes", child) + " already is a child of " +
                           at("nodes", static_cast<std::size_t>(parents[child])));
            }
            parents[child] = static_cast<std::int32_t>(i);
        }
    }
    return parents;
}

/// File indices, parents first; the lowest index that is ready comes next, so a file in good order keeps its order.
std::vector<std::uint32_t> parents_first(const tinygltf::Model& model, const std::vector<std::int32_t>& parents) {
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] < 0) ready.push(static_cast<std::uint32_t>(i));
    }
    std::vector<std::uint32_t> order;
    std::vector<bool> placed(parents.size(), false);
    while (!ready.empty()) {
        const std::uint32_t node = ready.top();
        ready.pop();
        order.push_back(node);
        placed[node] = true;
        for (const int child : model.nodes[node].children) ready.push(static_cast<std::uint32_t>(child));
    }
    // Every node has one parent at most, so what no root reaches hangs on a cycle.
    if (const auto lost = std::ranges::find(placed, false); lost != placed.end()) {
        refuse(at("nodes", static_cast<std::size_t>(lost - placed.begin())), "it is its own ancestor");
    }
    return order;
}

void read_transform(const tinygltf::Node& source, const std::string& place, Node& node) {
    const auto number = [](double x) { return static_cast<float>(x); };
    if (!source.matrix.empty()) {
        glm::mat4 matrix;
        std::ranges::transform(source.matrix, glm::value_ptr(matrix), number);
        node.matrix = matrix;
        return;
    }
    if (source.translation.size() == 3)
        std::ranges::transform(source.translation, glm::value_ptr(node.rest.translation), number);
    if (source.scale.size() == 3) std::ranges::transform(source.scale, glm::value_ptr(node.rest.scale), number);
    if (source.rotation.size() == 4) {
        const std::vector<double>& q = source.rotation;
        const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (!(length > 0)) refuse(place + ".rotation", "it has length zero");
        node.rest.rotation = {number(q[3] / length), number(q[0] / length), number(q[1] / length),
                              number(q[2] / length)};
    }
}

/// Marks what the file's scene shows. A file without scenes shows all.
std::vector<bool> nodes_in_scene(const tinygltf::Model& model, const std::vector<std::uint32_t>& order,
                                 const std::vector<std::int32_t>& parents) {
    std::vector<bool> shown(model.nodes.size(), model.scenes.empty());
    if (model.scenes.empty()) return shown;
    const auto scene = static_cast<std::size_t>(std::max(0, model.defaultScene));
    for (const int root : model.scenes[scene].nodes) shown[static_cast<std::size_t>(root)] = true;
    for (const std::uint32_t node : order) {
        if (parents[node] >= 0 && shown[static_cast<std::size_t>(parents[node])]) shown[node] = true;
    }
    return shown;
}

void check_joints_of_mesh(const Face& face, std::size_t mesh, std::size_t joint_count, const std::string& node_place) {
    for (std::uint32_t p = 0; p < face.meshes[mesh].primitive_count; ++p) {
        const Primitive& primitive = face.primitives[face.meshes[mesh].first_primitive + p];
        for (std::uint32_t v = 0; v < primitive.vertex_count && !face.joints.empty(); ++v) {
            for (glm::length_t c = 0; c < 4; ++c) {
                const std::uint32_t joint = face.joints[primitive.first_vertex + v][c];
                if (joint >= joint_count && face.joint_weights[primitive.first_vertex + v][c] > 0) {
                    refuse(at("meshes", mesh) + "." + at("primitives", p) + ".attributes.JOINTS_0",
                           "vertex " + std::to_string(v) + " names joint " + std::to_string(joint) +
                               ", but the skin of " + node_place + " has " + std::to_string(joint_count));
                }
            }
        }
    }
}

}  // namespace

NodeOrder read_nodes(GltfDocument& document, Face& face) {
    const tinygltf::Model& model = document.model;
    const std::vector<std::int32_t> parents = parents_of(model);
    const std::vector<std::uint32_t> order = parents_first(model, parents);
    const std::vector<bool> shown = nodes_in_scene(model, order, parents);
    NodeOrder new_index(order.size());
    std::size_t hidden_meshes = 0;
    for (const std::uint32_t file_index : order) {
        const tinygltf::Node& source = model.nodes[file_index];
        new_index[file_index] = static_cast<std::uint32_t>(face.nodes.size());
        Node node;
        node.name = source.name;
        node.file_index = file_index;
        if (parents[file_index] >= 0) {
            node.parent = static_cast<std::int32_t>(new_index[static_cast<std::size_t>(parents[file_index])]);
        }
        read_transform(source, at("nodes", file_index), node);
        if (shown[file_index]) {
            node.mesh = source.mesh;
            node.skin = source.skin;
        } else if (source.mesh >= 0) {
            ++hidden_meshes;
        }
        face.nodes.push_back(std::move(node));
    }
    if (hidden_meshes > 0) {
        document.notes.push_back(std::to_string(hidden_meshes) +
                                 " nodes with a mesh are outside the file's scene and are not drawn");
    }
    return new_index;
}

void read_skins(GltfDocument& document, const NodeOrder& order, Face& face) {
    for (std::size_t s = 0; s < document.model.skins.size(); ++s) {
        const tinygltf::Skin& source = document.model.skins[s];
        const std::string place = at("skins", s);
        if (source.joints.empty()) refuse(place + ".joints", "a skin needs at least one joint");
        Skin skin;
        for (const int joint : source.joints) skin.joints.push_back(order[static_cast<std::size_t>(joint)]);
        document.spend(16 * skin.joints.size(), place);
        skin.joint_from_mesh.assign(skin.joints.size(), glm::mat4(1));
        if (source.inverseBindMatrices >= 0) {
            const auto numbers = read_floats(document, {static_cast<std::size_t>(source.inverseBindMatrices),
                                                        place + ".inverseBindMatrices", 16, skin.joints.size()});
            for (std::size_t i = 0; i < skin.joints.size(); ++i)
                skin.joint_from_mesh[i] = glm::make_mat4(&numbers[16 * i]);
        }
        face.skins.push_back(std::move(skin));
    }
    std::set<std::pair<std::int32_t, std::int32_t>> checked;
    for (Node& node : face.nodes) {
        if (node.skin < 0 || node.mesh < 0 || !checked.emplace(node.mesh, node.skin).second) continue;
        check_joints_of_mesh(face, static_cast<std::size_t>(node.mesh),
                             face.skins[static_cast<std::size_t>(node.skin)].joints.size(),
                             at("nodes", node.file_index));
    }
}

}  // namespace blush::load
