#pragma once
/// Nodes and skins of a glTF document into a Face.

#include "rig/face.h"
#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

/// For each node of the file its index in Face::nodes.
using NodeOrder = std::vector<std::uint32_t>;

/// Fills face.nodes, parents before children and otherwise in file order. Throws BadFile for cycles and for a node with
/// two parents.
NodeOrder read_nodes(GltfDocument& document, Face& face);

/// Fills face.skins and checks the joints of every skinned vertex. Needs nodes and meshes. Throws BadFile.
void read_skins(GltfDocument& document, const NodeOrder& order, Face& face);

}  // namespace blush::load
