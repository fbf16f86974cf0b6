#pragma once
/// Materials, textures and images of a glTF document into a Face.

#include "rig/face.h"
#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

/// Fills face.images (those that a material uses) and face.materials. Throws BadFile.
void read_materials(GltfDocument& document, Face& face);

}  // namespace blush::load
