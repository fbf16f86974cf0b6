#pragma once
/// Morph targets: names, the union over meshes, and sparse deltas.

#include <string>
#include <unordered_map>

#include "rig/face.h"
#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

/// Gathers targets of one name in several meshes into one Target, in order of first appearance.
class TargetUnion {
public:
    TargetUnion(GltfDocument& document, Face& face);

    /// Names the targets of meshes[mesh] and returns the Face target of each. Throws BadFile.
    std::vector<std::uint32_t> begin_mesh(std::size_t mesh);

    /// Appends the deltas of one primitive, whose vertices are in the Face already. Throws BadFile.
    NormalSource add_primitive(const tinygltf::Primitive& source, const Primitive& primitive,
                               const std::vector<std::uint32_t>& mesh_targets, const std::string& place);

private:
    std::vector<std::string> names_of(std::size_t mesh);
    float default_weight(std::size_t mesh, std::size_t target) const;

    GltfDocument& document_;
    Face& face_;
    std::unordered_map<std::string, std::uint32_t> index_of_;
    std::vector<std::ptrdiff_t> first_node_of_;  ///< for each mesh the first node that draws it, -1: none
    std::size_t meshes_with_targets_ = 0;
};

}  // namespace blush::load
