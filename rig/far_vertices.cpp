#include "rig/far_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/controls/head_and_eyes.h"

namespace blush {
namespace {

Bounds bounds_of(const Face& face, std::size_t mesh) {
    Bounds bounds;
    for (const Primitive& primitive : face.primitives) {
        if (primitive.mesh != mesh) continue;
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v)
            bounds.add(face.positions[v]);
    }
    return bounds;
}

/// For each mesh the first of those that it must move with, since they follow joints of one skin.
std::vector<std::size_t> groups(const Face& face) {
    std::vector<std::size_t> group(face.meshes.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    std::vector<std::int32_t> mesh_of_skin(face.skins.size(), -1);
    for (const Node& node : face.nodes) {
        if (node.mesh < 0 || node.skin < 0) continue;
        std::int32_t& first = mesh_of_skin[static_cast<std::size_t>(node.skin)];
        if (first < 0) first = node.mesh;
        const std::size_t from = group[static_cast<std::size_t>(node.mesh)],
                          to = group[static_cast<std::size_t>(first)];
        std::ranges::replace(group, std::max(from, to), std::min(from, to));
    }
    return group;
}

/// What can be taken off each coordinate of these bounds without rounding; 0 along an axis that is not far out.
glm::vec3 origin_of(const Bounds& bounds) {
    glm::vec3 origin(0);
    const glm::vec3 middle = bounds.centre(), half = 0.5F * bounds.size();
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        constexpr float exact = 4;  // all coordinates are within a factor of two of the middle, with room to spare
        if (std::abs(middle[axis]) >= exact * half[axis]) origin[axis] = middle[axis];
    }
    return origin;
}

float largest(glm::vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// A child draws what the node drew, and stands where the vertices were.
void move_to_child(Face& face, std::size_t node, glm::vec3 origin) {
    Node child;
    child.parent = static_cast<std::int32_t>(node);
    child.rest.translation = origin;
    child.mesh = face.nodes[node].mesh;
    child.skin = face.nodes[node].skin;
    child.file_index = face.nodes[node].file_index;
    face.nodes[node].mesh = face.nodes[node].skin = -1;
    face.nodes.push_back(child);
}

double step_at(float coordinate) {
    const float size = std::abs(coordinate);
    return static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity())) -
           static_cast<double>(size);
}

/// How long the longest axis of a mesh's units is in the file's space.
double longest_axis(const glm::dmat4& matrix) {
    return std::max(
        {glm::length(glm::dvec3(matrix[0])), glm::length(glm::dvec3(matrix[1])), glm::length(glm::dvec3(matrix[2]))});
}

}  // namespace

Recentred recentre(Face& face) {
    Recentred result{std::vector<glm::vec3>(face.meshes.size(), glm::vec3(0)),
                     std::vector<glm::vec3>(face.skins.size(), glm::vec3(0))};
    std::vector<Bounds> bounds;
    float reach = 0;
    for (std::size_t m = 0; m < face.meshes.size(); ++m) {
        bounds.push_back(bounds_of(face, m));
        if (!bounds[m].empty()) reach = std::max(reach, largest(0.5F * bounds[m].size()));
    }
    const std::vector<std::size_t> group = groups(face);
    for (std::size_t m = 0; m < face.meshes.size(); ++m) {
        Bounds of_group;
        for (std::size_t other = 0; other < face.meshes.size(); ++other) {
            if (group[other] != group[m] || bounds[other].empty()) continue;
            of_group.add(bounds[other].low);
            of_group.add(bounds[other].high);
        }
        if (of_group.empty() || !(largest(of_group.centre()) > far_ratio * reach)) continue;
        const glm::vec3 origin = origin_of(of_group);
        result.mesh_origin[m] = origin;
        for (const Primitive& primitive : face.primitives) {
            if (primitive.mesh != m) continue;
            for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v)
                face.positions[v] -= origin;
        }
    }
    const std::size_t nodes = face.nodes.size();
    for (std::size_t n = 0; n < nodes; ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const glm::vec3 origin = result.mesh_origin[static_cast<std::size_t>(face.nodes[n].mesh)];
        if (origin == glm::vec3(0)) continue;
        if (face.nodes[n].skin >= 0) result.skin_origin[static_cast<std::size_t>(face.nodes[n].skin)] = origin;
        move_to_child(face, n, origin);
    }
    for (std::size_t s = 0; s < face.skins.size(); ++s) {
        if (result.skin_origin[s] == glm::vec3(0)) continue;
        for (glm::mat4& joint_from_mesh : face.skins[s].joint_from_mesh) {
            joint_from_mesh = glm::mat4(glm::translate(glm::dmat4(joint_from_mesh), glm::dvec3(result.skin_origin[s])));
        }
    }
    return result;
}

double float_step(const Face& face) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    double step = 0;
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        const Node& node = face.nodes[n];
        if (node.mesh < 0) continue;
        double units = longest_axis(placed[n]);
        if (node.skin >= 0) {
            units = 0;
            const Skin& skin = face.skins[static_cast<std::size_t>(node.skin)];
            for (std::size_t j = 0; j < skin.joints.size(); ++j)
                units = std::max(units, longest_axis(placed[skin.joints[j]] * glm::dmat4(skin.joint_from_mesh[j])));
        }
        const Bounds bounds = bounds_of(face, static_cast<std::size_t>(node.mesh));
        if (bounds.empty()) continue;
        step = std::max(step, units * step_at(std::max(largest(bounds.low), largest(bounds.high))));
    }
    return step;
}

}  // namespace blush
