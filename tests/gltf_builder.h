#pragma once
/// Small GLB files made by tests: one mesh, one primitive, one node, and whatever a test adds to or breaks in `json`
/// and `bin`.
///
///     GlbBuilder glb;
///     glb.grid(8, 8).target("jawOpen", {3, 4}, {{0, -1, 0}, {0, -1, 0}}).write(path);

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace blush::test {

class GlbBuilder {
public:
    nlohmann::json json = {
        {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}, {"nodes", {{{"mesh", 0}}}}};
    std::vector<std::uint8_t> bin;

    /// Vertices and triangles of the one primitive; call it (or grid()) first.
    GlbBuilder& surface(const std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& triangles) {
        vertex_count_ = positions.size();
        nlohmann::json primitive;
        primitive["attributes"]["POSITION"] = accessor(positions, "VEC3");
        primitive["indices"] = accessor(triangles, "SCALAR", 5125);
        json["meshes"] = {{{"primitives", nlohmann::json::array({primitive})}}};
        return *this;
    }

    /// A square of side 2 around the origin in the plane z = 0, facing +z, with normals and texture coordinates:
    /// (columns + 1) * (rows + 1) vertices, row by row from the lower left.
    GlbBuilder& grid(std::uint32_t columns, std::uint32_t rows) {
        std::vector<glm::vec3> positions, normals;
        std::vector<glm::vec2> uv;
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t y = 0; y <= rows; ++y) {
            for (std::uint32_t x = 0; x <= columns; ++x) {
                const float u = static_cast<float>(x) / static_cast<float>(columns);
                const float v = static_cast<float>(y) / static_cast<float>(rows);
                positions.emplace_back(2 * u - 1, 2 * v - 1, 0);
                normals.emplace_back(0, 0, 1);
                uv.emplace_back(u, 1 - v);
                if (x == columns || y == rows) continue;
                const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
                triangles.insert(triangles.end(), {a, b, d, a, d, c});
            }
        }
        surface(positions, triangles);
        return attribute("NORMAL", normals).attribute("TEXCOORD_0", uv);
    }

    /// NORMAL, TEXCOORD_0 and so on, one value a vertex.
    template <class T>
    GlbBuilder& attribute(const std::string& name, const std::vector<T>& values) {
        primitive()["attributes"][name] = accessor(values, type_of(values));
        return *this;
    }

    /// A target that is only a sparse accessor: `vertices` ascending, one delta each. `normal_deltas` may be empty.
    GlbBuilder& target(const std::string& name, const std::vector<std::uint32_t>& vertices,
                       const std::vector<glm::vec3>& deltas, const std::vector<glm::vec3>& normal_deltas = {}) {
        nlohmann::json target = {{"POSITION", sparse_accessor(vertices, deltas)}};
        if (!normal_deltas.empty()) target["NORMAL"] = sparse_accessor(vertices, normal_deltas);
        return add_target(name, target);
    }

    /// A target with one delta for each vertex of the primitive.
    GlbBuilder& dense_target(const std::string& name, const std::vector<glm::vec3>& deltas,
                             const std::vector<glm::vec3>& normal_deltas = {}) {
        nlohmann::json target = {{"POSITION", accessor(deltas, "VEC3")}};
        if (!normal_deltas.empty()) target["NORMAL"] = accessor(normal_deltas, "VEC3");
        return add_target(name, target);
    }

    /// An animation of all targets' weights: times.size() * targets values (three times as many for CUBICSPLINE).
    GlbBuilder& weight_animation(const std::vector<float>& times_seconds, const std::vector<float>& values,
                                 const std::string& interpolation = "LINEAR") {
        return animation("weights", accessor(times_seconds, "SCALAR"), accessor(values, "SCALAR"), interpolation);
    }

    /// An animation of node 0: "translation", "rotation" (x, y, z, w) or "scale".
    template <class T>
    GlbBuilder& node_animation(const std::string& path, const std::vector<float>& times_seconds,
                               const std::vector<T>& values, const std::string& interpolation = "LINEAR") {
        return animation(path, accessor(times_seconds, "SCALAR"), accessor(values, type_of(values)), interpolation);
    }

    /// The one primitive's JSON.
    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

    /// Appends values to `bin` with a bufferView and an accessor; returns the accessor's index.
    template <class T>
    std::size_t accessor(const std::vector<T>& values, const std::string& type, int component_type = 5126) {
        const std::size_t buffer_view = view(std::as_bytes(std::span(values)));
        json["accessors"].push_back(
            {{"bufferView", buffer_view}, {"componentType", component_type}, {"count", values.size()}, {"type", type}});
        return json["accessors"].size() - 1;
    }

    std::size_t sparse_accessor(const std::vector<std::uint32_t>& elements, const std::vector<glm::vec3>& values) {
        const std::size_t indices = view(std::as_bytes(std::span(elements)));
        const std::size_t replaced = view(std::as_bytes(std::span(values)));
        json["accessors"].push_back({{"componentType", 5126},
                                     {"count", vertex_count_},
                                     {"type", "VEC3"},
                                     {"sparse",
                                      {{"count", elements.size()},
                                       {"indices", {{"bufferView", indices}, {"componentType", 5125}}},
                                       {"values", {{"bufferView", replaced}}}}}});
        return json["accessors"].size() - 1;
    }

    std::size_t view(std::span<const std::byte> bytes) {
        while (bin.size() % 4 != 0) bin.push_back(0);
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}});
        const std::size_t offset = bin.size();
        bin.resize(offset + bytes.size());
        if (!bytes.empty()) std::memcpy(bin.data() + offset, bytes.data(), bytes.size());
        return json["bufferViews"].size() - 1;
    }

    /// The whole file. A "buffers" entry that a test has set itself is kept.
    std::vector<std::uint8_t> bytes() const {
        nlohmann::json complete = json;
        if (!complete.contains("buffers")) complete["buffers"] = {{{"byteLength", bin.size()}}};
        return file_of(complete.dump(), bin);
    }

    /// A GLB around any JSON text.
    static std::vector<std::uint8_t> file_of(std::string text, std::vector<std::uint8_t> binary) {
        while (text.size() % 4 != 0) text.push_back(' ');
        while (binary.size() % 4 != 0) binary.push_back(0);
        std::vector<std::uint8_t> file;
        const auto u32 = [&](std::size_t value) {
            for (unsigned shift = 0; shift < 32; shift += 8)
                file.push_back(static_cast<std::uint8_t>((value >> shift) & 0xFFU));
        };
        u32(0x46546C67), u32(2), u32(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
        u32(text.size()), u32(0x4E4F534A);
        file.insert(file.end(), text.begin(), text.end());
        if (!binary.empty()) {
            u32(binary.size()), u32(0x004E4942);
            file.insert(file.end(), binary.begin(), binary.end());
        }
        return file;
    }

    void write(const std::filesystem::path& path) const { write_file(path, bytes()); }

    static void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> content) {
        std::ofstream stream(path, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    }

private:
    static const char* type_of(const std::vector<float>&) { return "SCALAR"; }
    static const char* type_of(const std::vector<glm::vec2>&) { return "VEC2"; }
    static const char* type_of(const std::vector<glm::vec3>&) { return "VEC3"; }
    static const char* type_of(const std::vector<glm::vec4>&) { return "VEC4"; }

    GlbBuilder& add_target(const std::string& name, const nlohmann::json& target) {
        primitive()["targets"].push_back(target);
        json["meshes"][0]["extras"]["targetNames"].push_back(name);
        return *this;
    }

    GlbBuilder& animation(const std::string& path, std::size_t input, std::size_t output,
                          const std::string& interpolation) {
        json["animations"].push_back(
            {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
        return *this;
    }

    std::size_t vertex_count_ = 0;
};

/// A folder for one test's files, removed at its end.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "blush_test_XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace blush::test
