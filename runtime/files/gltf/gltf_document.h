#pragma once
/// A glTF document whose shape, extensions and byte ranges have been checked, ready to be read into a Face.

#include <tiny_gltf.h>

#include <nlohmann/json.hpp>

#include "runtime/files/face_file.h"
#include "runtime/files/gltf/gltf_buffers.h"

namespace blush::load {

struct GltfDocument {
    std::filesystem::path path;
    nlohmann::json json;    ///< passed check_schema(); for extensions and images, which `model` does not carry
    tinygltf::Model model;  ///< without images, cameras and buffer bytes
    GltfBuffers buffers;
    LoadLimits limits;
    std::uint64_t elements_left = 0;  ///< see spend()
    std::vector<std::string> notes;

    /// Accounts for `count` numbers, vertices or indices that are about to be stored. A file may name one accessor many
    /// times; this keeps what is stored in proportion to the bytes of the file. Throws BadFile.
    void spend(std::uint64_t count, std::string_view place);
};

/// Throws BadFile.
GltfDocument open_document(ByteView file, const std::filesystem::path& path, const LoadLimits& limits);

}  // namespace blush::load
