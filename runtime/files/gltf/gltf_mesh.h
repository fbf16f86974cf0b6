#pragma once
/// Meshes, primitives and morph targets of a glTF document into a Face.

#include <cstdint>
#include <vector>

#include "rig/face.h"
#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

/// For each mesh of the file, the Face target of each of the mesh's own targets.
using MeshTargets = std::vector<std::vector<std::uint32_t>>;

/// Fills everything of `face` that has one entry a vertex, its indices, primitives, meshes and targets.
/// face.materials must be filled before. Throws BadFile.
MeshTargets read_meshes(GltfDocument& document, Face& face);

}  // namespace blush::load
