#include "runtime/files/gltf/gltf_buffers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_meshopt.h"

namespace blush::load {
namespace {

using nlohmann::json;

std::size_t size_or(const json& object, const char* member, std::size_t otherwise) {
    const auto found = object.find(member);
    return found == object.end() ? otherwise : found->get<std::size_t>();
}

const json* meshopt_extension(const json& view) {
    const auto extensions = view.find("extensions");
    if (extensions == view.end()) return nullptr;
    const auto found = extensions->find("EXT_meshopt_compression");
    return found == extensions->end() ? nullptr : &*found;
}

}  // namespace

Bytes read_uri(const std::string& uri, const std::filesystem::path& gltf_path, std::uint64_t limit_bytes,
               const std::string& place) {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos) refuse(place, "the data: URI has no comma");
        const std::string_view header = std::string_view(uri).substr(0, comma);
        const std::string_view payload = std::string_view(uri).substr(comma + 1);
        if (header.ends_with(";base64")) return decode_base64(payload, place);
        const std::string text = decode_percent(payload);
        return Bytes(text.begin(), text.end());
    }
    if (uri.find("://") != std::string::npos) refuse(place, "\"" + uri + "\" is not a file beside this one");
    const std::filesystem::path relative = decode_percent(uri);
    if (relative.is_absolute() || uri.empty()) refuse(place, "\"" + uri + "\" is not a file beside this one");
    return read_file(gltf_path.parent_path() / relative, limit_bytes, place + " (\"" + uri + "\")");
}

GltfBuffers::GltfBuffers(const json& document, std::optional<ByteView> binary, const std::filesystem::path& gltf_path,
                         std::uint64_t limit_bytes) {
    const json none = json::array();
    const json& buffers = document.contains("buffers") ? document["buffers"] : none;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string place = at("buffers", i);
        const auto stated_bytes = buffers[i]["byteLength"].get<std::size_t>();
        std::optional<ByteView> bytes;
        if (buffers[i].contains("uri")) {
            const std::uint64_t left = limit_bytes - std::min(limit_bytes, total_bytes_);
            owned_.push_back(
                read_uri(buffers[i]["uri"].get_ref<const std::string&>(), gltf_path, left, place + ".uri"));
            bytes = owned_.back();
        } else if (i == 0 && binary) {
            bytes = binary;
        }
        if (bytes) {
            if (bytes->size() < stated_bytes) {
                refuse(place, "byteLength is " + std::to_string(stated_bytes) + ", but there are only " +
                                  std::to_string(bytes->size()) + " bytes");
            }
            bytes = bytes->first(stated_bytes);
            total_bytes_ += stated_bytes;
        }
        buffers_.push_back(bytes);
    }

    const json& views = document.contains("bufferViews") ? document["bufferViews"] : none;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string place = at("bufferViews", i);
        View view;
        view.stride = size_or(views[i], "byteStride", 0);
        // glTF 2.0, 5.11.4: 4 to 252 in steps of 4; tinygltf refuses the rest too, with less to say.
        if (view.stride > 252 || view.stride % 4 != 0) {
            refuse(place + ".byteStride", std::to_string(view.stride) + " is not a multiple of 4 up to 252");
        }
        if (const json* extension = meshopt_extension(views[i])) {
            const std::string inner = place + ".extensions.EXT_meshopt_compression";
            view.meshopt = extension;
            view.stride = (*extension)["byteStride"].get<std::size_t>();
            view.bytes = slice((*extension)["buffer"].get<std::size_t>(), size_or(*extension, "byteOffset", 0),
                               (*extension)["byteLength"].get<std::size_t>(), inner);
            const std::size_t decoded_bytes = check_meshopt(*extension, view.bytes.size(), inner);
            if (decoded_bytes != views[i]["byteLength"].get<std::size_t>()) {
                refuse(inner, "count times byteStride is not the bufferView's byteLength");
            }
            total_bytes_ += decoded_bytes;
        } else if (const auto buffer = views[i]["buffer"].get<std::size_t>(); buffers_[buffer]) {
            view.bytes =
                slice(buffer, size_or(views[i], "byteOffset", 0), views[i]["byteLength"].get<std::size_t>(), place);
        } else {
            view.absent = true;
        }
        views_.push_back(view);
    }
}

ByteView GltfBuffers::slice(std::size_t buffer, std::size_t offset, std::size_t length,
                            const std::string& place) const {
    const std::optional<ByteView>& bytes = buffers_[buffer];
    if (!bytes) refuse(at("buffers", buffer), "it has no data: no uri, and it is not the BIN chunk of a GLB");
    if (offset > bytes->size() || length > bytes->size() - offset) {
        refuse(place, "bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                          " are beyond the " + std::to_string(bytes->size()) + " bytes of " + at("buffers", buffer));
    }
    return bytes->subspan(offset, length);
}

ByteView GltfBuffers::view(std::size_t index) {
    View& view = views_[index];
    if (view.absent)
        refuse(at("bufferViews", index), "its buffer has no data: no uri, and it is not the BIN chunk of a GLB");
    if (view.meshopt) {
        const std::string place = at("bufferViews", index) + ".extensions.EXT_meshopt_compression";
        owned_.push_back(decode_meshopt(*view.meshopt, view.bytes, place));
        view.bytes = owned_.back();
        view.meshopt = nullptr;
    }
    return view.bytes;
}

}  // namespace blush::load
