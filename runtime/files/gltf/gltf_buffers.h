#pragma once
/// The bytes behind a glTF document's buffers and bufferViews, all ranges checked against bytes that exist.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "runtime/files/bytes.h"

namespace blush::load {

class GltfBuffers {
public:
    /// Reads every buffer of `json` (which passed check_schema): the GLB's own, data: URIs and files beside
    /// `gltf_path`. Checks every bufferView. Throws BadFile.
    GltfBuffers() = default;
    GltfBuffers(const nlohmann::json& json, std::optional<ByteView> binary, const std::filesystem::path& gltf_path,
                std::uint64_t limit_bytes);

    /// The bytes of bufferViews[index]; EXT_meshopt_compression is decoded at the first call. Throws BadFile.
    ByteView view(std::size_t index);

    /// Distance of elements in bytes that bufferViews[index] states, 0: tightly packed.
    std::size_t stride(std::size_t index) const { return views_[index].stride; }

    /// All bytes that the file can yield: buffers plus decoded views.
    std::uint64_t total_bytes() const { return total_bytes_; }

private:
    struct View {
        ByteView bytes;
        std::size_t stride = 0;
        const nlohmann::json* meshopt = nullptr;  ///< not yet decoded; `bytes` are the compressed ones
        bool absent = false;                      ///< lies in a buffer without data
    };
    ByteView slice(std::size_t buffer, std::size_t offset, std::size_t length, const std::string& place) const;

    std::vector<Bytes> owned_;                      ///< from files, URIs and decoders
    std::vector<std::optional<ByteView>> buffers_;  ///< nothing: a placeholder that only meshopt views may use
    std::vector<View> views_;
    std::uint64_t total_bytes_ = 0;
};

/// Resolves a URI of the document beside `gltf_path`: the bytes of a data: URI or of a file. Throws BadFile.
Bytes read_uri(const std::string& uri, const std::filesystem::path& gltf_path, std::uint64_t limit_bytes,
               const std::string& place);

}  // namespace blush::load
