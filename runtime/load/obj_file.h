#pragma once
/// Wavefront OBJ through OpenMesh's reader.

#include "runtime/face_file.h"
#include "runtime/load/bytes.h"

namespace blush::load {

/// One mesh without targets. Throws BadFile.
Face read_obj(ByteView file, const LoadLimits& limits);

}  // namespace blush::load
