/// blush info: what a file holds, and what of it was not understood.

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "rig/far_vertices.h"
#include "rig/head/face_scale.h"
#include "runtime/files/face_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

using Json = nlohmann::ordered_json;

float largest_move(const Target& target) {
    float largest = 0;
    for (const glm::vec3 delta : target.position_deltas) largest = std::max(largest, glm::length(delta));
    return largest;
}

std::uint32_t vertices_of(const Face& face, const Mesh& mesh) {
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
        count += face.primitives[mesh.first_primitive + p].vertex_count;
    }
    return count;
}

std::uint32_t triangles_of(const Face& face, const Mesh& mesh) {
    std::uint32_t count = 0;
    for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
        count += face.primitives[mesh.first_primitive + p].index_count / 3;
    }
    return count;
}

Json describe(const Face& face) {
    Json json;
    json["file"] = face.path;
    json["vertices"] = face.positions.size();
    json["triangles"] = face.indices.size() / 3;
    const FaceScale scale = face_scale(face);
    json["scale"] = {{"millimetres_a_unit", scale.millimetres_a_unit}, {"told_by", scale.told_by}};
    json["float_step_mm"] = float_step(face) * scale.millimetres_a_unit;
    json["meshes"] = Json::array();
    for (const Mesh& mesh : face.meshes) {
        json["meshes"].push_back({{"name", mesh.name},
                                  {"primitives", mesh.primitive_count},
                                  {"vertices", vertices_of(face, mesh)},
                                  {"triangles", triangles_of(face, mesh)}});
    }
    json["targets"] = Json::array();
    for (const Target& target : face.targets) {
        json["targets"].push_back({{"name", target.name},
                                   {"vertices_moved", target.vertices.size()},
                                   {"largest_move", largest_move(target)},
                                   {"own_normals", !target.normal_deltas.empty()},
                                   {"default_weight", target.default_weight}});
    }
    json["materials"] = Json::array();
    for (const Material& material : face.materials) {
        const auto image = material.base_color_srgb.image;
        json["materials"].push_back(
            {{"name", material.name},
             {"base_color_image", image < 0 ? Json() : Json(face.images[static_cast<std::size_t>(image)].name)},
             {"normal_map", material.normal.image >= 0},
             {"roughness", material.roughness},
             {"metallic", material.metallic}});
    }
    json["images"] = Json::array();
    for (const Image& image : face.images) {
        json["images"].push_back({{"name", image.name},
                                  {"width", image.width},
                                  {"height", image.height},
                                  {"channels", image.channels},
                                  {"bits", image.bytes.empty() ? 32 : 8}});
    }
    json["nodes"] = face.nodes.size();
    json["skins"] = face.skins.size();
    json["animations"] = Json::array();
    for (const Animation& animation : face.animations) {
        json["animations"].push_back({{"name", animation.name},
                                      {"duration_seconds", animation.duration_seconds},
                                      {"node_channels", animation.nodes.size()},
                                      {"weight_channels", animation.weights.size()}});
    }
    json["not_understood"] = face.notes;
    return json;
}

void print(const Json& json) {
    const auto text = [](const Json& value) { return value.get<std::string>(); };
    std::cout << text(json["file"]) << ": " << json["vertices"] << " vertices, " << json["triangles"] << " triangles, "
              << json["nodes"] << " nodes, " << json["skins"] << " skins\n"
              << "scale: " << json["scale"]["millimetres_a_unit"].get<float>() << " mm a unit, since "
              << text(json["scale"]["told_by"]) << "\n"
              << "vertices: neighbouring floats are " << json["float_step_mm"].get<float>() << " mm apart, at most\n";
    std::cout << "\nmeshes (" << json["meshes"].size() << ")\n";
    for (const Json& mesh : json["meshes"]) {
        std::cout << "  " << (text(mesh["name"]).empty() ? "(unnamed)" : text(mesh["name"])) << ": " << mesh["vertices"]
                  << " vertices, " << mesh["triangles"] << " triangles, " << mesh["primitives"] << " primitives\n";
    }
    std::cout << "\ntargets (" << json["targets"].size() << "): name, vertices moved, largest move, default weight\n";
    for (const Json& target : json["targets"]) {
        char line[160];
        std::snprintf(line, sizeof line, "  %-28s %8zu  %12.6g  %8.4g%s\n", text(target["name"]).c_str(),
                      target["vertices_moved"].get<std::size_t>(), target["largest_move"].get<double>(),
                      target["default_weight"].get<double>(),
                      target["own_normals"].get<bool>() ? "" : "  (no normals of its own)");
        std::cout << line;
    }
    std::cout << "\nmaterials (" << json["materials"].size() << ")\n";
    for (const Json& material : json["materials"]) {
        std::cout << "  " << (text(material["name"]).empty() ? "(unnamed)" : text(material["name"])) << ": roughness "
                  << material["roughness"].get<float>() << ", metallic " << material["metallic"].get<float>()
                  << (material["base_color_image"].is_null() ? "" : ", base colour map")
                  << (material["normal_map"].get<bool>() ? ", normal map" : "") << "\n";
    }
    for (const Json& image : json["images"]) {
        std::cout << "  image " << image["name"] << ": " << image["width"] << "x" << image["height"] << ", "
                  << image["channels"] << " channels, " << image["bits"] << " bits\n";
    }
    std::cout << "\nanimations (" << json["animations"].size() << ")\n";
    for (const Json& animation : json["animations"]) {
        std::cout << "  " << (text(animation["name"]).empty() ? "(unnamed)" : text(animation["name"])) << ": "
                  << animation["duration_seconds"].get<float>() << " s, " << animation["weight_channels"]
                  << " weight and " << animation["node_channels"] << " node channels\n";
    }
    std::cout << "\nnot understood (" << json["not_understood"].size() << ")\n";
    for (const Json& note : json["not_understood"]) std::cout << "  " << text(note) << "\n";
}

int info(const std::string& face_name, bool as_json) {
    const Result<Face> face = load_face(face_path(face_name));
    if (!face) return fail(face.error());
    const Json json = describe(*face);
    if (as_json) {
        // Names come from a file and may be no valid UTF-8: such bytes are replaced.
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
    } else {
        print(json);
    }
    return 0;
}

}  // namespace

void add_info(Command& program) {
    struct Options {
        std::string face;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("info", "Say what a face file holds: meshes, targets, materials, animations");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    command.flag("--json", options->json, "Print JSON");
    command.runs([options] { return info(options->face, options->json); });
}

}  // namespace blush::tool
