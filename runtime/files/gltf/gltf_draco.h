#pragma once
/// KHR_draco_mesh_compression through libdraco.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

struct DracoGeometry {
    std::vector<std::uint32_t> triangles;                  ///< three indices a triangle, all below the vertex count
    std::map<std::string, std::vector<float>> attributes;  ///< "POSITION" and so on, as the accessors describe them
};

/// Decodes the geometry of `primitive`, whose extension object is `extension`. The decoded counts agree with the
/// primitive's accessors. Throws BadFile.
DracoGeometry decode_draco(GltfDocument& document, const tinygltf::Primitive& primitive,
                           const nlohmann::json& extension, const std::string& place);

}  // namespace blush::load
