#include "rig/controls/head_and_eyes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "rig/names.h"

namespace blush {
namespace {

glm::dmat4 matrix_of(const Transform& t) {
    glm::dmat4 matrix =
        glm::mat4_cast(glm::dquat(static_cast<double>(t.rotation.w), static_cast<double>(t.rotation.x),
                                  static_cast<double>(t.rotation.y), static_cast<double>(t.rotation.z)));
    matrix[0] *= static_cast<double>(t.scale.x);
    matrix[1] *= static_cast<double>(t.scale.y);
    matrix[2] *= static_cast<double>(t.scale.z);
    matrix[3] = glm::dvec4(t.translation, 1);
    return matrix;
}

glm::dmat4 turn_of(const Angles& angles) {
    const auto about = [](float radians, glm::dvec3 axis) {
        return glm::rotate(glm::dmat4(1), static_cast<double>(radians), axis);
    };
    return about(angles.yaw_radians, {0, 1, 0}) * about(angles.pitch_radians, {1, 0, 0}) *
           about(angles.roll_radians, {0, 0, 1});
}

bool still(const Angles& angles) {
    return angles.yaw_radians == 0 && angles.pitch_radians == 0 && angles.roll_radians == 0;
}

/// Turns a node about a point, with axes of the face. Left out where nothing turns, so that rest keeps its bits.
void turn(glm::dmat4& placed, const Pivot& pivot, const Angles& angles) {
    if (still(angles)) return;
    const auto centre = glm::dvec3(placed * glm::dvec4(pivot.point_node, 1));
    placed = glm::translate(glm::dmat4(1), centre) * turn_of(angles) * glm::translate(glm::dmat4(1), -centre) * placed;
}

/// For each node the nodes of its subtree that draw something; nodes are ordered parents first.
std::vector<std::vector<std::uint32_t>> drawing_nodes_below(const Face& face) {
    std::vector<std::vector<std::uint32_t>> below(face.nodes.size());
    for (std::size_t n = face.nodes.size(); n-- > 0;) {
        const Node& node = face.nodes[n];
        if (node.mesh >= 0) below[n].push_back(static_cast<std::uint32_t>(n));
        if (node.parent < 0) continue;
        auto& parent = below[static_cast<std::size_t>(node.parent)];
        parent.insert(parent.end(), below[n].begin(), below[n].end());
    }
    return below;
}

void add_mesh(const Face& face, std::int32_t mesh_index, const glm::mat4& matrix, Bounds& bounds) {
    const Mesh& mesh = face.meshes[static_cast<std::size_t>(mesh_index)];
    for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
        const Primitive& primitive = face.primitives[mesh.first_primitive + p];
        for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
            bounds.add(glm::vec3(matrix * glm::vec4(face.positions[primitive.first_vertex + v], 1)));
        }
    }
}

/// Bounds in double precision: of a face that stands far out, floats would put a point that it turns about elsewhere.
struct FineBounds {
    glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
    void add(glm::dvec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    glm::dvec3 centre() const { return 0.5 * low + 0.5 * high; }
};

void add_mesh(const Face& face, std::int32_t mesh_index, const glm::dmat4& matrix, FineBounds& bounds) {
    const Mesh& mesh = face.meshes[static_cast<std::size_t>(mesh_index)];
    for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
        const Primitive& primitive = face.primitives[mesh.first_primitive + p];
        for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
            bounds.add(glm::dvec3(matrix * glm::dvec4(face.positions[primitive.first_vertex + v], 1)));
        }
    }
}

/// A point, or the origin where a node of zero scale has no inverse.
glm::vec3 finite_or_origin(glm::vec3 point) {
    const bool finite = std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
    return finite ? point : glm::vec3(0);
}

std::vector<glm::mat4> rest_matrices(const Face& face) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    return {placed.begin(), placed.end()};
}

}  // namespace

HeadAndEyes find_head_and_eyes(const Face& face) {
    HeadAndEyes found;
    const auto below = drawing_nodes_below(face);
    const std::vector<glm::dmat4> world = rest_placement(face);
    const auto drawn =
        static_cast<std::size_t>(std::ranges::count_if(face.nodes, [](const Node& node) { return node.mesh >= 0; }));
    const auto bounds_in = [&](std::size_t root) {
        const glm::dmat4 node_from_world = glm::inverse(world[root]);
        FineBounds bounds;
        for (const std::uint32_t n : below[root]) {
            add_mesh(face, face.nodes[n].mesh, node_from_world * world[n], bounds);
        }
        return bounds;
    };

    // Deeper nodes come later, so the last that holds everything is the lowest.
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (drawn == 0 || below[n].size() != drawn) continue;
        FineBounds bounds;  // in the world, since "up" is the world's
        for (const std::uint32_t d : below[n]) add_mesh(face, face.nodes[d].mesh, world[d], bounds);
        constexpr double neck_height = 1.0 / 3;
        const glm::dvec3 point(bounds.centre().x, bounds.low.y + neck_height * (bounds.high.y - bounds.low.y),
                               bounds.centre().z);
        found.head = {static_cast<std::int32_t>(n),
                      finite_or_origin(glm::vec3(glm::inverse(world[n]) * glm::dvec4(point, 1)))};
    }

    const auto find_eye = [&](std::string_view side) {
        const std::string wanted = canonical_name("eye" + std::string(side));
        for (std::size_t n = 0; n < face.nodes.size(); ++n) {
            const std::string name = canonical_name(face.nodes[n].name);
            if (!name.ends_with(wanted) || below[n].empty() || below[n].size() == drawn) continue;
            const FineBounds bounds = bounds_in(n);
            const bool origin_inside = glm::all(glm::lessThan(bounds.low, glm::dvec3(0))) &&
                                       glm::all(glm::greaterThan(bounds.high, glm::dvec3(0)));
            return Pivot{static_cast<std::int32_t>(n),
                         origin_inside ? glm::vec3(0) : finite_or_origin(glm::vec3(bounds.centre()))};
        }
        return Pivot{};
    };
    found.left_eye = find_eye("Left");
    found.right_eye = find_eye("Right");
    if (found.left_eye.node >= 0 && found.right_eye.node >= 0) {
        const auto x_of = [&](const Pivot& eye) {
            return (world[static_cast<std::size_t>(eye.node)] * glm::dvec4(eye.point_node, 1)).x;
        };
        if (x_of(found.left_eye) < x_of(found.right_eye)) std::swap(found.left_eye, found.right_eye);
    }
    return found;
}

void place_nodes(const Face& face, const Pose& pose, const HeadAndEyes& pivots, std::span<glm::dmat4> placed) {
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        const Node& node = face.nodes[n];
        placed[n] = node.matrix ? glm::dmat4(*node.matrix) : matrix_of(pose.nodes[n]);
        if (node.parent >= 0) placed[n] = placed[static_cast<std::size_t>(node.parent)] * placed[n];
        const auto index = static_cast<std::int32_t>(n);
        if (index == pivots.head.node) turn(placed[n], pivots.head, pose.head);
        if (index == pivots.left_eye.node) turn(placed[n], pivots.left_eye, pose.left_eye);
        if (index == pivots.right_eye.node) turn(placed[n], pivots.right_eye, pose.right_eye);
    }
}

std::vector<glm::dmat4> rest_placement(const Face& face) {
    Pose pose;
    for (const Node& node : face.nodes) pose.nodes.push_back(node.rest);
    std::vector<glm::dmat4> placed(face.nodes.size());
    place_nodes(face, pose, {}, placed);
    return placed;
}

void skinned_from_meshes(const Face& face, std::span<const glm::dmat4> placed, glm::dvec3 origin,
                         std::span<glm::mat4> joints) {
    std::size_t at = 0;
    for (const Skin& skin : face.skins) {
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            glm::dmat4 joint = placed[skin.joints[j]] * glm::dmat4(skin.joint_from_mesh[j]);
            joint[3] -= glm::dvec4(origin, 0);
            joints[at++] = glm::mat4(joint);
        }
    }
}

Bounds moving_bounds(const Face& face) {
    const std::vector<glm::mat4> world = rest_matrices(face);
    Bounds bounds;
    std::vector<std::int32_t> node_of_mesh(face.meshes.size(), -1);
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        add_mesh(face, face.nodes[n].mesh, world[n], bounds);
        node_of_mesh[static_cast<std::size_t>(face.nodes[n].mesh)] = static_cast<std::int32_t>(n);
    }
    std::vector<std::int32_t> node_of_vertex(face.positions.size(), -1);
    for (const Primitive& primitive : face.primitives) {
        std::fill_n(node_of_vertex.begin() + primitive.first_vertex, primitive.vertex_count,
                    node_of_mesh[primitive.mesh]);
    }
    for (const Target& target : face.targets) {
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            const std::int32_t node = node_of_vertex[target.vertices[i]];
            if (node < 0) continue;
            const glm::vec3 moved = face.positions[target.vertices[i]] + target.position_deltas[i];
            bounds.add(glm::vec3(world[static_cast<std::size_t>(node)] * glm::vec4(moved, 1)));
        }
    }
    return bounds;
}

}  // namespace blush
