#include "rig/head/eye_sockets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rig/controls/head_and_eyes.h"

namespace blush {
namespace {

struct DrawnVertex {
    std::uint32_t vertex;
    std::size_t node;
    glm::vec3 world;  // at rest
};

/// Each vertex of the primitives of one kind, once for each node that draws it.
std::vector<DrawnVertex> vertices_of(const Face& face, const std::vector<MaterialKind>& kinds, MaterialKind kind) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    const std::vector<glm::mat4> world(placed.begin(), placed.end());
    std::vector<DrawnVertex> found;
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0 || face.nodes[n].skin >= 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            const std::size_t material =
                primitive.material < 0 ? face.materials.size() : static_cast<std::size_t>(primitive.material);
            if (kinds[material] != kind) continue;
            for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
                found.push_back({v, n, glm::vec3(world[n] * glm::vec4(face.positions[v], 1))});
            }
        }
    }
    return found;
}

/// In the world.
Eyeball eyeball_of(const std::vector<DrawnVertex>& vertices) {
    Eyeball eye;
    eye.node = vertices.front().node;
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const DrawnVertex& drawn : vertices) {
        if (drawn.world.z > high.z) eye.pole = drawn.vertex;
        low = glm::min(low, drawn.world);
        high = glm::max(high, drawn.world);
    }
    // Across and up the ball has no bulge; its front, the cornea's, stands out a little, and its back may be missing.
    eye.centre = 0.5F * (low + high);
    eye.radius = 0.25F * (high.x - low.x + high.y - low.y);
    constexpr float cornea = 1.06F;  // its apex, in radii from the eyeball's centre
    eye.centre.z = high.z - cornea * eye.radius;
    return eye;
}

/// The edge of one lid: among `skin`, nearest to the axis for each direction. up: 1 or -1.
bool find_edge(const std::vector<DrawnVertex>& skin, const Eyeball& eye, float up,
               std::array<std::uint32_t, lid_point_count>& edge) {
    std::array<float, lid_point_count> nearest{};
    nearest.fill(std::numeric_limits<float>::max());
    for (const DrawnVertex& drawn : skin) {
        const glm::vec3 from = (drawn.world - eye.centre) / eye.radius;
        const float distance = glm::length(from);
        // On the eyeball or a lid's thickness above it, on its front.
        if (!(distance > 0.9F && distance < 1.4F && from.z > 0.2F * distance) || from.y * up < 0) continue;
        const float direction = std::atan2(from.y * up, from.x);  // 0 to pi
        const auto bin =
            std::min(static_cast<std::size_t>(direction / 3.1415927F * lid_point_count), lid_point_count - 1);
        const float off_axis = glm::length(glm::vec2(from)) / distance;
        if (off_axis >= nearest[bin]) continue;
        nearest[bin] = off_axis;
        edge[bin] = drawn.vertex;
    }
    constexpr float none = std::numeric_limits<float>::max();
    const auto found = std::ranges::count_if(nearest, [](float value) { return value < none; });
    if (found < static_cast<std::ptrdiff_t>(lid_point_count * 2 / 3)) return false;
    for (std::size_t k = 0; k < lid_point_count; ++k) {
        for (std::size_t off = 1; nearest[k] == none && off < lid_point_count; ++off) {
            if (k >= off && nearest[k - off] < none)
                edge[k] = edge[k - off];
            else if (k + off < lid_point_count && nearest[k + off] < none)
                edge[k] = edge[k + off];
            else
                continue;
            break;
        }
    }
    return true;
}

void to_meshes(const Face& face, EyeSockets& sockets) {
    const std::vector<glm::dmat4> placed = rest_placement(face);
    const std::vector<glm::mat4> world(placed.begin(), placed.end());
    for (Eyeball& eye : sockets.eyes) {
        eye.centre = glm::vec3(glm::inverse(world[eye.node]) * glm::vec4(eye.centre, 1));
        eye.radius /= std::max(glm::length(glm::vec3(world[eye.node][0])), 1e-30F);
    }
}

}  // namespace

EyeSockets find_eye_sockets(const Face& face, const std::vector<MaterialKind>& kinds) {
    EyeSockets sockets;
    const std::vector<DrawnVertex> balls = vertices_of(face, kinds, MaterialKind::eye);
    if (balls.empty()) return sockets;
    float low = std::numeric_limits<float>::max(), high = -low;
    for (const DrawnVertex& drawn : balls) {
        low = std::min(low, drawn.world.x);
        high = std::max(high, drawn.world.x);
    }
    std::vector<DrawnVertex> sides[2];
    for (const DrawnVertex& drawn : balls) {
        sides[drawn.world.x < 0.5F * (low + high) ? 0 : 1].push_back(drawn);
    }
    if (sides[0].empty() || sides[1].empty()) return sockets;
    const Eyeball left = eyeball_of(sides[0]), right = eyeball_of(sides[1]);
    // Two balls with a nose between them; a single one falls into halves that touch.
    const bool apart = right.centre.x - left.centre.x > 1.2F * (left.radius + right.radius);
    if (!(left.radius > 0) || !(right.radius > 0)) return sockets;
    if (apart) {
        sockets.eyes = {left, right};
    } else {
        const Eyeball one = eyeball_of(balls);
        sockets.eyes = {one, one};
    }
    const std::vector<DrawnVertex> skin = vertices_of(face, kinds, MaterialKind::skin);
    if (skin.empty()) {
        to_meshes(face, sockets);
        return sockets;
    }
    sockets.lid_node = skin.front().node;
    for (const Eyeball& eye : sockets.eyes) {
        LidEdges edges;
        if (!find_edge(skin, eye, 1, edges.upper) || !find_edge(skin, eye, -1, edges.lower)) {
            sockets.lids.clear();
            break;
        }
        sockets.lids.push_back(edges);
    }
    to_meshes(face, sockets);
    return sockets;
}

}  // namespace blush
