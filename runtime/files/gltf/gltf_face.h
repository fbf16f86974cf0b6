#pragma once
/// A whole glTF file into a Face.

#include "runtime/files/bytes.h"
#include "runtime/files/face_file.h"

namespace blush::load {

/// `path` is where `file` came from, for files beside it. Throws BadFile.
Face read_gltf(ByteView file, const std::filesystem::path& path, const LoadLimits& limits);

}  // namespace blush::load
