#pragma once
/// Animations of nodes and of morph weights (glTF 2.0, 3.11) into a Face.

#include "runtime/files/gltf/gltf_mesh.h"
#include "runtime/files/gltf/gltf_scene.h"

namespace blush::load {

/// Fills face.animations. Throws BadFile.
void read_animations(GltfDocument& document, const NodeOrder& order, const MeshTargets& mesh_targets, Face& face);

}  // namespace blush::load
