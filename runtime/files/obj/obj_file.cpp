#include "runtime/files/obj/obj_file.h"

#include <OpenMesh/Core/IO/Options.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <sstream>
#include <tuple>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/missing_attributes.h"
#include "runtime/files/import/obj_importer.h"
#include "runtime/files/obj/obj_text.h"

namespace blush::load {
namespace {

/// A message stream of OpenMesh's belongs to the whole program, so to the host too: silent here, then as it was.
class Silence {
public:
    explicit Silence(OpenMesh::mostream& stream) : stream_(stream), was_enabled_(stream.is_enabled()) {
        stream_.disable();
    }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
    ~Silence() {
        if (was_enabled_) stream_.enable();
    }

private:
    OpenMesh::mostream& stream_;
    bool was_enabled_;
};

/// OpenMesh's reader is one object for the whole program as well.
ObjImporter import(const std::string& text) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    ObjImporter importer;
    OpenMesh::IO::Options options = OpenMesh::IO::Options::FaceTexCoord;
    options += OpenMesh::IO::Options::VertexNormal;
    std::istringstream stream(text);
    const Silence errors(omerr()), log(omlog());
    if (!OpenMesh::IO::OBJReader().read(stream, importer, options)) refuse("", "OpenMesh cannot read the file");
    return importer;
}

/// A corner of a polygon, or a vertex that no polygon uses (its place is then `nowhere`).
struct Corner {
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
    std::uint32_t vertex;
    glm::vec2 uv;
    std::size_t place;
};

/// Appends the vertices that `corners` need to the face; returns for each place the face vertex.
std::vector<std::uint32_t> add_vertices(std::vector<Corner> corners, std::size_t place_count, const ObjImporter& source,
                                        Face& face) {
    const auto key = [](const Corner& c) { return std::tuple(c.vertex, c.uv.x, c.uv.y); };
    std::ranges::sort(corners, {}, key);
    std::vector<std::uint32_t> vertex_at(place_count);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& corner = corners[i];
        if (i == 0 || key(corners[i - 1]) != key(corner)) {
            face.positions.push_back(source.positions[corner.vertex]);
            face.normals.push_back(source.normal_sums[corner.vertex]);
            face.uv0.push_back(corner.uv);
        }
        if (corner.place != Corner::nowhere) {
            vertex_at[corner.place] = static_cast<std::uint32_t>(face.positions.size()) - 1;
        }
    }
    return vertex_at;
}

void normalise(glm::vec3& sum) {
    const double length = glm::length(glm::dvec3(sum));
    sum = length > 0 && std::isfinite(length) ? glm::vec3(glm::dvec3(sum) / length) : glm::vec3(0);
}

void add_primitive(const ObjImporter& source, const ObjText& text, std::int32_t material, Face& face) {
    std::vector<Corner> corners;
    std::vector<std::size_t> polygon_sizes;
    std::size_t places = 0;
    for (std::size_t i = 0; i < source.polygons.size(); ++i) {
        if (text.face_materials[i] != material) continue;
        const ObjImporter::Polygon& polygon = source.polygons[i];
        for (std::size_t c = 0; c < polygon.vertices.size(); ++c) {
            const glm::vec2 uv = polygon.uv.empty() ? glm::vec2(0) : glm::vec2(polygon.uv[c].x, 1.0F - polygon.uv[c].y);
            corners.push_back({polygon.vertices[c], uv, places++});
        }
        polygon_sizes.push_back(polygon.vertices.size());
    }
    if (polygon_sizes.empty()) return;
    if (face.primitives.empty()) {
        std::vector<bool> used(source.positions.size(), false);
        for (const ObjImporter::Polygon& polygon : source.polygons) {
            for (const std::uint32_t vertex : polygon.vertices) used[vertex] = true;
        }
        for (std::uint32_t v = 0; v < used.size(); ++v) {
            if (!used[v]) corners.push_back({v, glm::vec2(0), Corner::nowhere});
        }
    }
    Primitive primitive;
    primitive.material = material;
    primitive.first_vertex = static_cast<std::uint32_t>(face.positions.size());
    primitive.first_index = static_cast<std::uint32_t>(face.indices.size());
    const std::vector<std::uint32_t> vertex_at = add_vertices(std::move(corners), places, source, face);
    std::size_t first = 0;
    for (const std::size_t size : polygon_sizes) {
        for (std::size_t c = 1; c + 1 < size; ++c) {
            for (const std::size_t corner : {first, first + c, first + c + 1})
                face.indices.push_back(vertex_at[corner]);
        }
        first += size;
    }
    primitive.vertex_count = static_cast<std::uint32_t>(face.positions.size()) - primitive.first_vertex;
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size()) - primitive.first_index;
    primitive.authored_normals = std::ranges::any_of(source.normal_sums, [](glm::vec3 n) { return n != glm::vec3(0); });
    face.primitives.push_back(primitive);
}

}  // namespace

Face read_obj(ByteView file, const LoadLimits& limits) {
    ObjText text = check_obj(file, limits.vertices);
    if (text.face_materials.empty()) refuse("", "the file has no faces (statements v and f)");
    const ObjImporter source = import(text.text);
    if (source.positions.size() != text.vertex_count || source.polygons.size() != text.face_materials.size()) {
        refuse("", "OpenMesh did not read all vertices and faces");
    }
    Face face;
    for (std::string& name : text.materials) {
        Material material;
        material.name = std::move(name);
        material.metallic = 0;
        face.materials.push_back(std::move(material));
    }
    for (std::int32_t m = 0; m < static_cast<std::int32_t>(face.materials.size()); ++m)
        add_primitive(source, text, m, face);
    std::ranges::for_each(face.normals, normalise);
    face.tangents.resize(face.positions.size(), glm::vec4(0));
    face.uv1.resize(face.positions.size(), glm::vec2(0));
    face.meshes.push_back({"", 0, static_cast<std::uint32_t>(face.primitives.size())});
    Node node;
    node.mesh = 0;
    face.nodes.push_back(std::move(node));
    fill_missing_attributes(face, 0);
    face.notes = std::move(text.notes);
    return face;
}

}  // namespace blush::load
