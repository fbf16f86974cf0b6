#include "runtime/files/gltf/gltf_document.h"

#include <algorithm>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_container.h"
#include "runtime/files/gltf/gltf_schema.h"

namespace blush::load {
namespace {

using nlohmann::json;

constexpr std::string_view understood_extensions[] = {"KHR_mesh_quantization",      "EXT_meshopt_compression",
                                                      "KHR_draco_mesh_compression", "KHR_texture_transform",
                                                      "KHR_texture_basisu",         "KHR_materials_specular"};

bool is_understood(std::string_view name) {
    return std::ranges::find(understood_extensions, name) != std::end(understood_extensions);
}

void check_extensions(const json& document, std::vector<std::string>& notes) {
    if (document.contains("extensionsRequired")) {
        const json& required = document["extensionsRequired"];
        for (std::size_t i = 0; i < required.size(); ++i) {
            const auto& name = required[i].get_ref<const std::string&>();
            if (!is_understood(name)) {
                refuse(at("extensionsRequired", i),
                       "the file requires the extension \"" + name + "\", which is not understood");
            }
        }
    }
    if (document.contains("extensionsUsed")) {
        for (const json& used : document["extensionsUsed"]) {
            const auto& name = used.get_ref<const std::string&>();
            if (!is_understood(name))
                notes.push_back("the optional extension \"" + name + "\" is not understood and was left out");
        }
    }
}

/// What tinygltf gets to see: the structure alone. Bytes and images are read and checked by this room itself, so
/// tinygltf opens no file and decodes nothing. Three valid shapes that Debian's 2.7.0 refuses or drops are given a
/// stand-in, which parse_model() takes back.
json structure_of(const json& document) {
    json structure = document;
    for (const char* unread : {"images", "cameras", "extensions", "extras"}) structure.erase(unread);
    structure["buffers"] = json::array({{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}}});
    // Indices without a bufferView (Draco) are refused, so such accessors name one view more than the file has.
    json& views = structure["bufferViews"];
    const std::size_t stand_in = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    if (structure.contains("accessors")) {
        for (json& accessor : structure["accessors"]) {
            if (!accessor.contains("bufferView")) accessor["bufferView"] = stand_in;
        }
    }
    // A channel without a node is dropped, which would shift the numbers of those after it.
    if (structure.contains("animations")) {
        for (json& animation : structure["animations"]) {
            if (!animation.contains("channels")) continue;
            for (json& channel : animation["channels"]) {
                if (!channel["target"].contains("node")) channel["target"]["node"] = -1;
            }
        }
    }
    return structure;
}

std::string one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

tinygltf::Model parse_model(const json& document) {
    const std::string text = structure_of(document).dump();
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error, warning;
    const bool parsed =
        parser.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "");
    if (!parsed) refuse("", "tinygltf cannot read the JSON (" + one_line(error) + ")");
    const int stand_in = static_cast<int>(model.bufferViews.size()) - 1;
    for (tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView == stand_in) accessor.bufferView = -1;
    }
    model.bufferViews.pop_back();
    return model;
}

}  // namespace

void GltfDocument::spend(std::uint64_t count, std::string_view place) {
    if (count > elements_left) refuse(place, "the file names more elements than its bytes can hold");
    elements_left -= count;
}

GltfDocument open_document(ByteView file, const std::filesystem::path& path, const LoadLimits& limits) {
    GltfContainer container = open_container(file);
    check_schema(container.json);
    std::vector<std::string> notes;
    check_extensions(container.json, notes);
    GltfDocument document{path, std::move(container.json), {}, {}, limits, 0, std::move(notes)};
    document.buffers = GltfBuffers(document.json, container.binary, path, limits.file_bytes);
    document.model = parse_model(document.json);
    // The slack allows small files to leave out data that glTF lets them leave out (zeros, indices of a triangle soup).
    constexpr std::uint64_t slack = 4'000'000;
    document.elements_left = slack + 4 * document.buffers.total_bytes();
    return document;
}

}  // namespace blush::load
