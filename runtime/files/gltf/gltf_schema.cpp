#include "runtime/files/gltf/gltf_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

using nlohmann::json;

enum class Kind { object, text, boolean, number, size, index };

struct Rule {
    // Members separated by dots; "[]" stands for each element of an array, "*" for each member of an object.
    std::string_view where;
    Kind kind;
    bool required = false;
    std::string_view array = {};  // Kind::index: the root array that is indexed
    std::size_t length = 0;       // of the last array on the way, 0: any
};

// tinygltf keeps several sizes in an int, so no size may be beyond one. Larger files are split into more buffers.
constexpr std::uint64_t largest_size = std::numeric_limits<std::int32_t>::max();

constexpr Rule rules[] = {
    {"asset", Kind::object, true},
    {"asset.version", Kind::text, true},
    {"extensionsUsed[]", Kind::text},
    {"extensionsRequired[]", Kind::text},
    {"scene", Kind::index, false, "scenes"},
    {"scenes[].nodes[]", Kind::index, false, "nodes"},

    {"buffers[].byteLength", Kind::size, true},
    {"buffers[].uri", Kind::text},
    {"bufferViews[].buffer", Kind::index, true, "buffers"},
    {"bufferViews[].byteOffset", Kind::size},
    {"bufferViews[].byteLength", Kind::size, true},
    {"bufferViews[].byteStride", Kind::size},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", Kind::index, true, "buffers"},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", Kind::size},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", Kind::size, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", Kind::size, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", Kind::size, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", Kind::text, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", Kind::text},

    {"accessors[].bufferView", Kind::index, false, "bufferViews"},
    {"accessors[].byteOffset", Kind::size},
    {"accessors[].componentType", Kind::size, true},
    {"accessors[].count", Kind::size, true},
    {"accessors[].type", Kind::text, true},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].sparse.count", Kind::size, true},
    {"accessors[].sparse.indices", Kind::object, true},
    {"accessors[].sparse.indices.bufferView", Kind::index, true, "bufferViews"},
    {"accessors[].sparse.indices.byteOffset", Kind::size},
    {"accessors[].sparse.indices.componentType", Kind::size, true},
    {"accessors[].sparse.values", Kind::object, true},
    {"accessors[].sparse.values.bufferView", Kind::index, true, "bufferViews"},
    {"accessors[].sparse.values.byteOffset", Kind::size},

    {"meshes[].name", Kind::text},
    {"meshes[].primitives[]", Kind::object, true},
    {"meshes[].primitives[].attributes", Kind::object, true},
    {"meshes[].primitives[].attributes.*", Kind::index, false, "accessors"},
    {"meshes[].primitives[].indices", Kind::index, false, "accessors"},
    {"meshes[].primitives[].material", Kind::index, false, "materials"},
    {"meshes[].primitives[].mode", Kind::size},
    {"meshes[].primitives[].targets[]", Kind::object},
    {"meshes[].primitives[].targets[].*", Kind::index, false, "accessors"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", Kind::index, true, "bufferViews"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", Kind::object, true},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes.*", Kind::size},
    {"meshes[].weights[]", Kind::number},

    {"nodes[].name", Kind::text},
    {"nodes[].mesh", Kind::index, false, "meshes"},
    {"nodes[].skin", Kind::index, false, "skins"},
    {"nodes[].children[]", Kind::index, false, "nodes"},
    {"nodes[].translation[]", Kind::number, false, {}, 3},
    {"nodes[].rotation[]", Kind::number, false, {}, 4},
    {"nodes[].scale[]", Kind::number, false, {}, 3},
    {"nodes[].matrix[]", Kind::number, false, {}, 16},
    {"nodes[].weights[]", Kind::number},

    {"skins[].joints[]", Kind::index, true, "nodes"},
    {"skins[].inverseBindMatrices", Kind::index, false, "accessors"},

    {"animations[].name", Kind::text},
    {"animations[].channels[].sampler", Kind::size, true},
    {"animations[].channels[].target", Kind::object, true},
    {"animations[].channels[].target.node", Kind::index, false, "nodes"},
    {"animations[].channels[].target.path", Kind::text, true},
    {"animations[].samplers[].input", Kind::index, true, "accessors"},
    {"animations[].samplers[].output", Kind::index, true, "accessors"},
    {"animations[].samplers[].interpolation", Kind::text},

    {"materials[].name", Kind::text},
    {"materials[].pbrMetallicRoughness.baseColorFactor[]", Kind::number, false, {}, 4},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].emissiveFactor[]", Kind::number, false, {}, 3},
    {"materials[].alphaMode", Kind::text},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].normalTexture.scale", Kind::number},
    {"materials[].occlusionTexture.strength", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularFactor", Kind::number},

    {"textures[].source", Kind::index, false, "images"},
    {"textures[].sampler", Kind::index, false, "samplers"},
    {"textures[].extensions.KHR_texture_basisu.source", Kind::index, false, "images"},
    {"samplers[].wrapS", Kind::size},
    {"samplers[].wrapT", Kind::size},
    {"images[].name", Kind::text},
    {"images[].uri", Kind::text},
    {"images[].mimeType", Kind::text},
    {"images[].bufferView", Kind::index, false, "bufferViews"},
};

constexpr std::string_view texture_uses[] = {"materials[].pbrMetallicRoughness.baseColorTexture",
                                             "materials[].pbrMetallicRoughness.metallicRoughnessTexture",
                                             "materials[].normalTexture",
                                             "materials[].occlusionTexture",
                                             "materials[].emissiveTexture",
                                             "materials[].extensions.KHR_materials_specular.specularTexture"};

constexpr Rule texture_use_rules[] = {
    {"index", Kind::index, true, "textures"},
    {"texCoord", Kind::size},
    {"extensions.KHR_texture_transform.offset[]", Kind::number, false, {}, 2},
    {"extensions.KHR_texture_transform.scale[]", Kind::number, false, {}, 2},
    {"extensions.KHR_texture_transform.rotation", Kind::number},
    {"extensions.KHR_texture_transform.texCoord", Kind::size},
};

void check_index(const json& value, const json& document, std::string_view array, std::string_view place) {
    const auto found = document.find(array);
    const std::size_t count = found != document.end() && found->is_array() ? found->size() : 0;
    if (!value.is_number_unsigned()) refuse(place, "must be an index, a whole number from 0");
    if (value.get<std::uint64_t>() >= count) {
        refuse(place, "there is no " + at(array, value.get<std::uint64_t>()) + ", the file has " +
                          std::to_string(count) + " " + std::string(array));
    }
}

void check_value(const json& value, const json& document, const Rule& rule, std::string_view place) {
    switch (rule.kind) {
        case Kind::object:
            if (!value.is_object()) refuse(place, "must be an object");
            break;
        case Kind::text:
            if (!value.is_string()) refuse(place, "must be a string");
            break;
        case Kind::boolean:
            if (!value.is_boolean()) refuse(place, "must be true or false");
            break;
        case Kind::number:
            if (!value.is_number()) refuse(place, "must be a number");
            if (!(std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max()))) {
                refuse(place, "is beyond the range of a float");
            }
            break;
        case Kind::size:
            if (!value.is_number_unsigned()) refuse(place, "must be a whole number from 0");
            if (value.get<std::uint64_t>() > largest_size) {
                refuse(place,
                       std::to_string(value.get<std::uint64_t>()) + " is beyond " + std::to_string(largest_size));
            }
            break;
        case Kind::index:
            check_index(value, document, rule.array, place);
            break;
    }
}

/// Walks `rest` of the rule's path below `value`; `place` is the way so far, restored on return.
void walk(const json& value, const json& document, const Rule& rule, std::string_view rest, std::string& place) {
    if (rest.empty()) return check_value(value, document, rule, place);
    if (!value.is_object()) refuse(place, "must be an object");
    const std::size_t dot = rest.find('.');
    std::string_view name = rest.substr(0, dot);
    const std::string_view below = dot == std::string_view::npos ? std::string_view() : rest.substr(dot + 1);
    const bool each_element = name.ends_with("[]");
    if (each_element) name.remove_suffix(2);
    const std::size_t length = place.size();
    const auto enter = [&](std::string_view member) {
        if (!place.empty()) place += '.';
        place += member;
    };
    if (name == "*") {
        for (const auto& [member, element] : value.items()) {
            enter(member);
            walk(element, document, rule, below, place);
            place.resize(length);
        }
        return;
    }
    enter(name);
    const auto found = value.find(name);
    if (found == value.end()) {
        if (rule.required && below.empty()) refuse(place, "is missing");
    } else if (!each_element) {
        walk(*found, document, rule, below, place);
    } else {
        if (!found->is_array()) refuse(place, "must be an array");
        if (rule.length != 0 && below.empty() && found->size() != rule.length) {
            refuse(place,
                   "must have " + std::to_string(rule.length) + " numbers, it has " + std::to_string(found->size()));
        }
        const std::size_t array_length = place.size();
        for (std::size_t i = 0; i < found->size(); ++i) {
            place += at("", i);
            walk((*found)[i], document, rule, below, place);
            place.resize(array_length);
        }
    }
    place.resize(length);
}

}  // namespace

void check_schema(const json& document) {
    std::string place;
    for (const Rule& rule : rules) walk(document, document, rule, rule.where, place);
    for (const std::string_view use : texture_uses) {
        for (Rule rule : texture_use_rules) {
            const std::string where = std::string(use) + "." + std::string(rule.where);
            walk(document, document, rule, where, place);
        }
    }
}

}  // namespace blush::load
