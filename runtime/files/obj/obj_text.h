#pragma once
/// A Wavefront OBJ text brought into the shape that OpenMesh's reader can be trusted with.

#include <string>
#include <vector>

#include "runtime/files/bytes.h"

namespace blush::load {

/// Only v, vt, vn and f statements, one a line: numbers finite, indices positive and in range, every face with at least
/// three different corners that either all have texture coordinates or none.
struct ObjText {
    std::string text;
    std::size_t vertex_count = 0;
    std::vector<std::string> materials;        ///< named by usemtl ("" before the first), in order of use
    std::vector<std::int32_t> face_materials;  ///< for each face of `text` an index into `materials`
    std::vector<std::string> notes;
};

/// Throws BadFile with the line number of the first statement that cannot be read.
ObjText check_obj(ByteView file, std::size_t vertex_limit);

}  // namespace blush::load
