#include "runtime/load/gltf_draco.h"

#include "runtime/load/bad_file.h"

namespace blush::load {

DracoGeometry decode_draco(GltfDocument&, const tinygltf::Primitive&, const nlohmann::json&, const std::string& place) {
    refuse(place, "Draco geometry cannot be read yet");
}

}  // namespace blush::load
