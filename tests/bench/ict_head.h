#pragma once
/// The ICT head as the benchmark needs it: positions, triangles and the position deltas of its 57 expressions, in the
/// vertex order of the OBJ files. Read from the published archive by tar.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rig/face.h"

namespace blush::bench {

/// Lines of what a command prints.
template <class Visit>
bool each_line(const std::string& command, Visit visit) {
    const auto close = [](std::FILE* pipe) { pclose(pipe); };
    const std::unique_ptr<std::FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
    if (!pipe) return false;
    char line[256];
    while (std::fgets(line, sizeof line, pipe.get()) != nullptr) visit(line);
    return true;
}

inline std::optional<Face> ict_head(const std::filesystem::path& archive) {
    const std::string quoted = "'" + archive.string() + "' 2>/dev/null";
    std::vector<std::string> names;
    each_line("tar -tJf " + quoted, [&](std::string name) {
        if (!name.empty() && name.back() == '\n') name.pop_back();
        if (name.ends_with(".obj")) names.push_back(std::filesystem::path(name).stem().string());
    });
    // All files one after another: one begins where vertices follow faces.
    std::vector<std::vector<glm::vec3>> meshes;
    std::vector<std::uint32_t> indices;
    bool in_faces = true;
    each_line("tar -xJOf " + quoted + " --wildcards '*.obj'", [&](const char* line) {
        if (line[0] == 'v' && line[1] == ' ') {
            if (in_faces) meshes.emplace_back();
            in_faces = false;
            char* at = nullptr;
            const float x = std::strtof(line + 2, &at), y = std::strtof(at, &at), z = std::strtof(at, &at);
            meshes.back().emplace_back(x, y, z);
        } else if (line[0] == 'f') {
            in_faces = true;
            if (meshes.size() > 1) return;
            std::vector<std::uint32_t> corners;
            const char* at = line + 1;
            for (char* next = nullptr;; at = next) {
                const unsigned long corner = std::strtoul(at, &next, 10);
                if (next == at) break;
                corners.push_back(static_cast<std::uint32_t>(corner - 1));
                while (*next != '\0' && *next != ' ' && *next != '\n') ++next;  // texture coordinate, normal
            }
            for (std::size_t c = 2; c < corners.size(); ++c) {
                indices.insert(indices.end(), {corners[0], corners[c - 1], corners[c]});
            }
        }
    });
    const auto neutral = std::ranges::find(names, "generic_neutral_mesh");
    if (names.empty() || meshes.size() != names.size() || neutral == names.end()) return std::nullopt;

    Face face;
    face.path = archive.string();
    face.positions = meshes[static_cast<std::size_t>(neutral - names.begin())];
    const std::size_t count = face.positions.size();
    face.normals.assign(count, glm::vec3(0, 0, 1));
    face.tangents.assign(count, glm::vec4(1, 0, 0, 1));
    face.uv0.assign(count, glm::vec2(0));
    face.uv1 = face.uv0;
    face.indices = std::move(indices);
    Primitive primitive;
    primitive.vertex_count = static_cast<std::uint32_t>(count);
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size());
    primitive.normal_source = NormalSource::recomputed;
    face.primitives = {primitive};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (names[m] == *neutral) continue;
        if (meshes[m].size() != count) return std::nullopt;
        Target target;
        target.name = names[m];
        for (std::uint32_t v = 0; v < count; ++v) {
            if (meshes[m][v] == face.positions[v]) continue;
            target.vertices.push_back(v);
            target.position_deltas.push_back(meshes[m][v] - face.positions[v]);
        }
        face.targets.push_back(std::move(target));
    }
    return face;
}

}  // namespace blush::bench
