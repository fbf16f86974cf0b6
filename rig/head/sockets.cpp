#include "rig/head/sockets.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "rig/deform/face_part.h"
#include "rig/names.h"

namespace blush {
namespace {

/// Vertices that a fit looks at, at most: more do not make it better, and each costs in every frame.
constexpr std::size_t most_vertices = 48;

struct NamedJoint {
    std::int32_t node = -1, joint = -1;
};

/// Of the joints of all skins, whether some vertex follows it.
std::vector<std::uint8_t> followed_joints(const Face& face) {
    std::size_t count = 0;
    for (const Skin& skin : face.skins) count += skin.joints.size();
    std::vector<std::uint8_t> followed(count, 0);
    if (face.joints.empty()) return followed;
    const std::vector<std::uint32_t> first = first_joints(face);
    for (std::size_t p = 0; p < face.primitives.size(); ++p) {
        const Primitive& primitive = face.primitives[p];
        for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            for (glm::length_t k = 0; k < 4; ++k) {
                const std::size_t joint = first[p] + face.joints[v][k];
                if (face.joint_weights[v][k] > 0 && joint < count) followed[joint] = 1;
            }
        }
    }
    return followed;
}

class Finder {
public:
    Finder(const Face& face, const std::vector<MaterialKind>& kinds)
        : face_(face), kinds_(kinds), rest_(rest_placement(face)), followed_(followed_joints(face)) {}

    std::optional<SocketSource> joint(std::initializer_list<std::string_view> endings) const {
        std::int32_t number = 0;
        for (const Skin& skin : face_.skins) {
            for (const std::uint32_t node : skin.joints) {
                if (followed_[static_cast<std::size_t>(number)] != 0 && is_named(node, endings)) {
                    SocketSource source = of_node(static_cast<std::int32_t>(node), glm::vec3(0));
                    source.joint = number;
                    return source;
                }
                ++number;
            }
        }
        return std::nullopt;
    }

    SocketSource of_node(std::int32_t node, glm::vec3 point_node) const {
        SocketSource source;
        source.kind = SocketSource::Kind::node;
        source.node = node;
        source.origin_face = glm::dvec3(rest_[static_cast<std::size_t>(node)] * glm::dvec4(point_node, 1));
        return source;
    }

    SocketSource pivot(const Pivot& pivot) const {
        return pivot.node < 0 ? SocketSource{} : of_node(pivot.node, pivot.point_node);
    }

    SocketSource eyeball(const Eyeball& eye) const {
        std::vector<std::pair<std::uint32_t, double>> near;
        const std::int32_t mesh = face_.nodes[eye.node].mesh;
        each_vertex_of(MaterialKind::eye, [&](const Primitive& primitive, std::uint32_t v) {
            const bool of_this = static_cast<std::int32_t>(primitive.mesh) == mesh &&
                                 glm::distance(face_.positions[v], eye.centre) < 1.3F * eye.radius;
            if (of_this) near.emplace_back(v, 1);
        });
        return surface(std::move(near));
    }

    SocketSource chin() const {
        std::vector<std::pair<std::uint32_t, double>> moved;
        const std::string wanted = canonical_name("jawOpen");
        for (const Target& target : face_.targets) {
            const std::string name = canonical_name(target.name);
            if (!name.ends_with(wanted)) continue;
            std::vector<float> moves(face_.positions.size(), 0);
            for (std::size_t i = 0; i < target.vertices.size(); ++i)
                moves[target.vertices[i]] = glm::length(target.position_deltas[i]);
            float farthest = 0;
            each_vertex_of(MaterialKind::skin,
                           [&](const Primitive&, std::uint32_t v) { farthest = std::max(farthest, moves[v]); });
            if (!(farthest > 0)) continue;
            constexpr float with_the_bone = 0.7F;
            each_vertex_of(MaterialKind::skin, [&](const Primitive&, std::uint32_t v) {
                if (moves[v] >= with_the_bone * farthest) moved.emplace_back(v, static_cast<double>(moves[v]));
            });
            break;
        }
        return surface(std::move(moved));
    }

    SocketSource node(std::string_view ending) const {
        for (std::uint32_t n = 0; n < face_.nodes.size(); ++n) {
            if (is_named(n, {ending}) && draws(n)) return of_node(static_cast<std::int32_t>(n), glm::vec3(0));
        }
        return {};
    }

private:
    bool is_named(std::uint32_t node, std::initializer_list<std::string_view> endings) const {
        const std::string name = canonical_name(face_.nodes[node].name);
        return std::ranges::any_of(endings, [&name](std::string_view end) { return name.ends_with(end); }) &&
               !name.ends_with("forehead");
    }
    bool draws(std::uint32_t root) const {
        std::vector<std::uint8_t> below(face_.nodes.size(), 0);
        below[root] = 1;
        for (std::size_t n = root; n < face_.nodes.size(); ++n) {
            const Node& node = face_.nodes[n];
            if (node.parent >= 0 && below[static_cast<std::size_t>(node.parent)] != 0) below[n] = 1;
            if (below[n] != 0 && node.mesh >= 0 && node.skin < 0) return true;
        }
        return false;
    }
    /// Of primitives that a node draws.
    template <class Visit>
    void each_vertex_of(MaterialKind kind, Visit visit) const {
        for (const Primitive& primitive : face_.primitives) {
            const std::size_t material =
                primitive.material < 0 ? face_.materials.size() : static_cast<std::size_t>(primitive.material);
            if (kinds_[material] != kind || drawing_node(face_, primitive.mesh) < 0) continue;
            for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v)
                visit(primitive, v);
        }
    }
    /// Some of them, evenly through their order, so that all of the patch is looked at.
    static SocketSource surface(std::vector<std::pair<std::uint32_t, double>> vertices) {
        SocketSource source;
        constexpr std::size_t fewest = 4;  // three that are not in one line, and one beside them
        if (vertices.size() < fewest) return source;
        source.kind = SocketSource::Kind::surface;
        const std::size_t count = std::min(most_vertices, vertices.size());
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [vertex, weight] = vertices[i * vertices.size() / count];
            source.vertices.push_back(vertex);
            source.weights.push_back(weight);
        }
        return source;
    }

    const Face& face_;
    const std::vector<MaterialKind>& kinds_;
    std::vector<glm::dmat4> rest_;
    std::vector<std::uint8_t> followed_;
};

}  // namespace

std::array<SocketSource, socket_count> find_sockets(const Face& face, const HeadAndEyes& head_and_eyes,
                                                    const EyeSockets& eyes, const std::vector<MaterialKind>& kinds) {
    const Finder find(face, kinds);
    SocketSource head = find.joint({"head"}).value_or(find.pivot(head_and_eyes.head));

    SocketSource jaw = find.joint({"jaw"}).value_or(find.chin());
    if (jaw.kind == SocketSource::Kind::none) jaw = find.node("jaw");

    SocketSource left = find.pivot(head_and_eyes.left_eye), right = find.pivot(head_and_eyes.right_eye);
    if (left.kind == SocketSource::Kind::none && right.kind == SocketSource::Kind::none) {
        left = find.joint({"eyeleft", "lefteye"}).value_or(SocketSource{});
        right = find.joint({"eyeright", "righteye"}).value_or(SocketSource{});
        // Some files name as the viewer sees them.
        if (left.node >= 0 && right.node >= 0 && left.origin_face.x < right.origin_face.x) std::swap(left, right);
    }
    if (eyes.eyes.size() == 2) {
        if (left.kind == SocketSource::Kind::none) left = find.eyeball(eyes.eyes[1]);
        if (right.kind == SocketSource::Kind::none) right = find.eyeball(eyes.eyes[0]);
    }
    return {std::move(head), std::move(jaw), std::move(left), std::move(right)};
}

}  // namespace blush
