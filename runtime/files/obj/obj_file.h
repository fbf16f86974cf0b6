#pragma once
/// Wavefront OBJ through OpenMesh's reader.

#include "runtime/files/bytes.h"
#include "runtime/files/face_file.h"

namespace blush::load {

/// One mesh without targets, one primitive a material. The vertices of a primitive are the OBJ's own, in their order,
/// each repeated for every further texture coordinate that it has in faces of that material; vertices without a face
/// belong to the first primitive. Polygons become triangle fans. Texture coordinates are turned to glTF's (v grows
/// downwards). Throws BadFile.
Face read_obj(ByteView file, const LoadLimits& limits);

}  // namespace blush::load
