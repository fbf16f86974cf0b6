#include "runtime/files/gltf/gltf_face.h"

#include "runtime/files/gltf/gltf_animation.h"
#include "runtime/files/gltf/gltf_document.h"
#include "runtime/files/gltf/gltf_material.h"
#include "runtime/files/gltf/gltf_mesh.h"
#include "runtime/files/gltf/gltf_scene.h"

namespace blush::load {

Face read_gltf(ByteView file, const std::filesystem::path& path, const LoadLimits& limits) {
    GltfDocument document = open_document(file, path, limits);
    Face face;
    const NodeOrder order = read_nodes(document, face);
    read_materials(document, face);
    const MeshTargets mesh_targets = read_meshes(document, face);
    read_skins(document, order, face);
    read_animations(document, order, mesh_targets, face);
    face.notes = std::move(document.notes);
    return face;
}

}  // namespace blush::load
