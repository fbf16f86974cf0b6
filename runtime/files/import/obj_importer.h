#pragma once
/// Receives what OpenMesh's OBJ reader finds, as plain arrays. (OpenMesh's own half-edge mesh would refuse or split
/// non-manifold faces and so change the file's vertices.)

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <glm/glm.hpp>
#include <vector>

namespace blush::load {

class ObjImporter : public OpenMesh::IO::BaseImporter {
    using VertexHandle = OpenMesh::VertexHandle;
    using HalfedgeHandle = OpenMesh::HalfedgeHandle;
    using EdgeHandle = OpenMesh::EdgeHandle;
    using FaceHandle = OpenMesh::FaceHandle;
    using StatusInfo = OpenMesh::Attributes::StatusInfo;
    using Vec2f = OpenMesh::Vec2f;
    using Vec3f = OpenMesh::Vec3f;
    using Vec3d = OpenMesh::Vec3d;
    using Vec4f = OpenMesh::Vec4f;
    using Vec3uc = OpenMesh::Vec3uc;
    using Vec4uc = OpenMesh::Vec4uc;

public:
    struct Polygon {
        std::vector<std::uint32_t> vertices;
        std::vector<glm::vec2> uv;  ///< one a corner, or empty
    };
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normal_sums;  ///< of all normals that faces give a vertex, zero: none
    std::vector<Polygon> polygons;

    VertexHandle add_vertex(const Vec3f& p) override {
        positions.emplace_back(p[0], p[1], p[2]);
        normal_sums.emplace_back(0);
        return VertexHandle(static_cast<int>(positions.size()) - 1);
    }
    VertexHandle add_vertex(const Vec3d& p) override { return add_vertex(Vec3f(p)); }
    VertexHandle add_vertex() override { return add_vertex(Vec3f(0, 0, 0)); }
    FaceHandle add_face(const VHandles& corners) override {
        Polygon polygon;
        for (const VertexHandle corner : corners) polygon.vertices.push_back(static_cast<std::uint32_t>(corner.idx()));
        polygons.push_back(std::move(polygon));
        return FaceHandle(static_cast<int>(polygons.size()) - 1);
    }
    void add_face_texcoords(FaceHandle face, VertexHandle, const std::vector<Vec2f>& uv) override {
        for (const Vec2f& pair : uv) polygons[static_cast<std::size_t>(face.idx())].uv.emplace_back(pair[0], pair[1]);
    }
    void set_normal(VertexHandle vertex, const Vec3f& n) override {
        normal_sums[static_cast<std::size_t>(vertex.idx())] += glm::vec3(n[0], n[1], n[2]);
    }
    void set_normal(VertexHandle vertex, const Vec3d& n) override { set_normal(vertex, Vec3f(n)); }
    std::size_t n_vertices() const override { return positions.size(); }
    std::size_t n_faces() const override { return polygons.size(); }
    std::size_t n_edges() const override { return 0; }

    // What OBJ files do not have or a face does not need.
    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_point(VertexHandle, const Vec3f&) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_color(VertexHandle, const Vec3uc&) override {}
    void set_color(VertexHandle, const Vec4uc&) override {}
    void set_color(VertexHandle, const Vec3f&) override {}
    void set_color(VertexHandle, const Vec4f&) override {}
    void set_texcoord(VertexHandle, const Vec2f&) override {}
    void set_status(VertexHandle, const StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
    void set_texcoord(VertexHandle, const Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
    void set_status(HalfedgeHandle, const StatusInfo&) override {}
    void set_color(EdgeHandle, const Vec3uc&) override {}
    void set_color(EdgeHandle, const Vec4uc&) override {}
    void set_color(EdgeHandle, const Vec3f&) override {}
    void set_color(EdgeHandle, const Vec4f&) override {}
    void set_status(EdgeHandle, const StatusInfo&) override {}
    void set_normal(FaceHandle, const Vec3f&) override {}
    void set_normal(FaceHandle, const Vec3d&) override {}
    void set_color(FaceHandle, const Vec3uc&) override {}
    void set_color(FaceHandle, const Vec4uc&) override {}
    void set_color(FaceHandle, const Vec3f&) override {}
    void set_color(FaceHandle, const Vec4f&) override {}
    void set_status(FaceHandle, const StatusInfo&) override {}
    void add_texture_information(int, std::string) override {}
};

}  // namespace blush::load
