#pragma once
/// A face as one binary glTF 2.0 file: the counterpart of load_face().

#include <span>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/result.h"
#include "runtime/files/bytes.h"

namespace blush::load {

/// An image as the file holds it.
struct PackedImage {
    std::string name, media_type;  ///< "image/png" or "image/jpeg"
    Bytes bytes;
};

/// The bytes of the .glb; the same face gives the same bytes. Numbers keep their bits: load_face() of the result has
/// the same positions, normals, texture coordinates, triangles, targets, nodes and materials. Targets become sparse
/// accessors (glTF 2.0, 3.6.2.3), one for positions and one for normals, without their zeros.
///
/// Textures index `images`; Face::images is not looked at. Tangents are left out, loaders compute them from the texture
/// coordinates; uv1 is written where some vertex of the primitive has one. Error: what is not written (skins,
/// animations, texture transforms) stands in the face.
Result<std::string> glb_bytes(const Face& face, std::span<const PackedImage> images, const std::string& generator);

}  // namespace blush::load
