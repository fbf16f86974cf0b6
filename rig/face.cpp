#include "rig/face.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace blush {
namespace {

/// What a loader normalises in floats is off by a few rounding errors at most.
constexpr float normalised_tolerance = 1e-4F;

bool finite(float x) { return std::isfinite(x); }
template <glm::length_t N>
bool finite(const glm::vec<N, float>& v) {
    for (glm::length_t c = 0; c < N; ++c) {
        if (!std::isfinite(v[c])) return false;
    }
    return true;
}
bool finite(const glm::mat4& m) { return finite(m[0]) && finite(m[1]) && finite(m[2]) && finite(m[3]); }
template <class Range>
bool all_finite(const Range& values) {
    return std::ranges::all_of(values, [](const auto& value) { return finite(value); });
}
bool is_unit(const glm::vec3& v) {
    // A little room for the rounding of a loader that compares in double precision.
    return std::abs(glm::length(v) - 1.0F) <= 1.001F * unit_length_tolerance;
}

/// Collects the first broken rule.
class Validation {
public:
    explicit Validation(const Face& face) : face_(face) {}

    Status run() {
        vertices();
        primitives();
        for (std::size_t i = 0; i < face_.targets.size(); ++i) target(i);
        for (std::size_t i = 0; i < face_.nodes.size(); ++i) node(i);
        for (std::size_t i = 0; i < face_.skins.size(); ++i) skin(i);
        for (std::size_t i = 0; i < face_.materials.size(); ++i) material(i);
        for (std::size_t i = 0; i < face_.images.size(); ++i) image(i);
        for (std::size_t i = 0; i < face_.animations.size(); ++i) animation(i);
        if (!broken_.empty()) return Error{face_.path + ": " + broken_};
        return Done{};
    }

private:
    // The text is made only when a rule is broken: these run once a vertex.
    template <class... Parts>
    void require(bool holds, const Parts&... parts) {
        if (!holds && broken_.empty()) (add(parts), ...);
    }
    void add(std::string_view text) { broken_ += text; }
    void add(std::size_t number) { broken_ += std::to_string(number); }

    std::size_t vertex_count() const { return face_.positions.size(); }

    void vertices() {
        const std::size_t count = vertex_count();
        require(count > 0, "the face has no vertices");
        require(count <= std::numeric_limits<std::uint32_t>::max(), "the face has too many vertices");
        require(face_.normals.size() == count, "normals: not one a vertex");
        require(face_.tangents.size() == count, "tangents: not one a vertex");
        require(face_.uv0.size() == count && face_.uv1.size() == count, "texture coordinates: not one a vertex");
        require(
            face_.joints.size() == face_.joint_weights.size() && (face_.joints.empty() || face_.joints.size() == count),
            "joints: not one a vertex");
        require(all_finite(face_.positions), "positions: not all are finite");
        require(all_finite(face_.uv0) && all_finite(face_.uv1), "texture coordinates: not all are finite");
        require(std::ranges::all_of(face_.normals, is_unit), "normals: not all have unit length");
        require(std::ranges::all_of(face_.tangents,
                                    [](const glm::vec4& t) { return is_unit(glm::vec3(t)) && std::abs(t.w) == 1.0F; }),
                "tangents: not all have unit length and a sign of 1 or -1");
        for (std::size_t i = 0; i < face_.joint_weights.size(); ++i) {
            const glm::vec4& w = face_.joint_weights[i];
            const float sum = w.x + w.y + w.z + w.w;
            const bool positive = glm::all(glm::greaterThanEqual(w, glm::vec4(0)));
            require(positive && (w == glm::vec4(0) || std::abs(sum - 1) <= normalised_tolerance), "joint_weights[", i,
                    "]: they do not sum to 1");
        }
    }

    void primitives() {
        require(face_.indices.size() <= std::numeric_limits<std::uint32_t>::max(), "indices: there are too many");
        for (std::size_t i = 0; i < face_.primitives.size(); ++i) {
            const Primitive& p = face_.primitives[i];
            const auto vertex_end = std::uint64_t{p.first_vertex} + p.vertex_count;
            const auto index_end = std::uint64_t{p.first_index} + p.index_count;
            require(p.mesh < face_.meshes.size(), "primitives[", i, "].mesh: there is no such mesh");
            require(vertex_end <= vertex_count(), "primitives[", i, "]: its vertices are out of range");
            require(index_end <= face_.indices.size(), "primitives[", i, "]: its indices are out of range");
            require(p.index_count % 3 == 0, "primitives[", i, "]: its indices do not make triangles");
            require(p.material >= -1 && p.material < static_cast<std::int64_t>(face_.materials.size()), "primitives[",
                    i, "].material: there is no such material");
            for (std::uint64_t k = p.first_index; broken_.empty() && k < index_end; ++k) {
                require(face_.indices[k] >= p.first_vertex && face_.indices[k] < vertex_end, "indices[", k,
                        "]: it is outside its primitive's vertices");
            }
        }
        for (std::size_t i = 0; i < face_.meshes.size(); ++i) {
            const Mesh& mesh = face_.meshes[i];
            require(std::uint64_t{mesh.first_primitive} + mesh.primitive_count <= face_.primitives.size(), "meshes[", i,
                    "]: its primitives are out of range");
        }
    }

    void target(std::size_t i) {
        const Target& t = face_.targets[i];
        const std::size_t count = t.vertices.size();
        require(t.position_deltas.size() == count, "targets[", i, "]: not one position delta a vertex");
        require(t.normal_deltas.empty() || t.normal_deltas.size() == count, "targets[", i,
                "]: not one normal delta a vertex");
        require(t.tangent_deltas.empty() || t.tangent_deltas.size() == count, "targets[", i,
                "]: not one tangent delta a vertex");
        require(std::ranges::adjacent_find(t.vertices, std::ranges::greater_equal()) == t.vertices.end(), "targets[", i,
                "]: its vertices are not strictly ascending");
        require(t.vertices.empty() || t.vertices.back() < vertex_count(), "targets[", i, "]: a vertex is out of range");
        require(all_finite(t.position_deltas) && all_finite(t.normal_deltas) && all_finite(t.tangent_deltas),
                "targets[", i, "]: not all deltas are finite");
        require(finite(t.default_weight), "targets[", i, "].default_weight: it is not finite");
    }

    void node(std::size_t i) {
        const Node& n = face_.nodes[i];
        require(n.parent >= -1 && n.parent < static_cast<std::int64_t>(i), "nodes[", i,
                "].parent: it does not come before");
        require(n.mesh >= -1 && n.mesh < static_cast<std::int64_t>(face_.meshes.size()), "nodes[", i,
                "].mesh: there is no such mesh");
        require(n.skin >= -1 && n.skin < static_cast<std::int64_t>(face_.skins.size()), "nodes[", i,
                "].skin: there is no such skin");
        const glm::vec4 q(n.rest.rotation.x, n.rest.rotation.y, n.rest.rotation.z, n.rest.rotation.w);
        require(std::abs(glm::dot(q, q) - 1.0F) <= 2 * normalised_tolerance, "nodes[", i,
                "].rotation: it has not unit length");
        require(finite(n.rest.translation) && finite(n.rest.scale), "nodes[", i, "]: its transform is not finite");
        require(!n.matrix || finite(*n.matrix), "nodes[", i, "].matrix: it is not finite");
        if (broken_.empty() && n.mesh >= 0 && n.skin >= 0)
            joints_of(face_.meshes[static_cast<std::size_t>(n.mesh)], face_.skins[static_cast<std::size_t>(n.skin)]);
    }

    void joints_of(const Mesh& mesh, const Skin& skin) {
        if (face_.joints.empty()) return;
        for (std::uint32_t k = 0; k < mesh.primitive_count; ++k) {
            const Primitive& p = face_.primitives[mesh.first_primitive + k];
            for (std::uint32_t v = p.first_vertex; v < p.first_vertex + p.vertex_count; ++v) {
                for (glm::length_t c = 0; c < 4; ++c) {
                    require(face_.joint_weights[v][c] <= 0 || face_.joints[v][c] < skin.joints.size(), "joints[", v,
                            "]: there is no such joint in its skin");
                }
            }
        }
    }

    void skin(std::size_t i) {
        const Skin& s = face_.skins[i];
        require(s.joint_from_mesh.size() == s.joints.size(), "skins[", i, "]: not one matrix a joint");
        require(std::ranges::all_of(s.joints, [&](std::uint32_t joint) { return joint < face_.nodes.size(); }),
                "skins[", i, "]: a joint is not a node");
        require(all_finite(s.joint_from_mesh), "skins[", i, "]: a matrix is not finite");
    }

    void material(std::size_t i) {
        const Material& m = face_.materials[i];
        require(finite(m.base_color_linear) && finite(m.emissive_linear) && finite(m.metallic) && finite(m.roughness) &&
                    finite(m.normal_scale) && finite(m.specular) && finite(m.occlusion_strength) &&
                    finite(m.alpha_cutoff),
                "materials[", i, "]: a factor is not finite");
        for (const TextureUse* use :
             {&m.base_color_srgb, &m.metallic_roughness, &m.normal, &m.occlusion, &m.emissive_srgb, &m.specular_map}) {
            require(use->image >= -1 && use->image < static_cast<std::int64_t>(face_.images.size()), "materials[", i,
                    "]: a texture has no such image");
            require(use->uv_set <= 1, "materials[", i, "]: a texture uses a coordinate set beyond 1");
            require(finite(use->uv_transform[0]) && finite(use->uv_transform[1]) && finite(use->uv_transform[2]),
                    "materials[", i, "]: a texture transform is not finite");
        }
    }

    void image(std::size_t i) {
        const Image& m = face_.images[i];
        const std::uint64_t numbers = std::uint64_t{m.width} * m.height * m.channels;
        require(numbers > 0 && m.channels <= 4, "images[", i, "]: it has no pixels or too many channels");
        const bool one_kind = m.bytes.empty() != m.floats.empty();
        require(one_kind && m.bytes.size() + m.floats.size() == numbers, "images[", i,
                "]: its pixels do not match its size");
        require(all_finite(m.floats), "images[", i, "]: not all pixels are finite");
    }

    void track(const Track& t, std::size_t width, std::size_t i) {
        const std::size_t floats_a_key = width * (t.interpolation == Interpolation::cubic_spline ? 3 : 1);
        require(t.width == width, "animations[", i, "]: a track has another width than what it moves");
        require(!t.times_seconds.empty(), "animations[", i, "]: a track has no keys");
        require(all_finite(t.times_seconds) && all_finite(t.values), "animations[", i, "]: not all keys are finite");
        require(std::ranges::adjacent_find(t.times_seconds, std::ranges::greater_equal()) == t.times_seconds.end(),
                "animations[", i, "]: key times are not strictly ascending");
        require(t.values.size() == t.times_seconds.size() * floats_a_key, "animations[", i,
                "]: values do not match the keys");
    }

    void animation(std::size_t i) {
        const Animation& a = face_.animations[i];
        float last_seconds = 0;
        for (const NodeChannel& channel : a.nodes) {
            require(channel.node < face_.nodes.size(), "animations[", i, "]: it moves a node that does not exist");
            track(channel.track, channel.path == NodePath::rotation ? 4 : 3, i);
            if (broken_.empty()) last_seconds = std::max(last_seconds, channel.track.times_seconds.back());
        }
        for (const WeightChannel& channel : a.weights) {
            require(std::ranges::all_of(channel.targets, [&](std::uint32_t t) { return t < face_.targets.size(); }),
                    "animations[", i, "]: it moves a target that does not exist");
            track(channel.track, channel.targets.size(), i);
            if (broken_.empty()) last_seconds = std::max(last_seconds, channel.track.times_seconds.back());
        }
        require(a.duration_seconds == last_seconds, "animations[", i,
                "].duration_seconds: it is not the last key's time");
    }

    const Face& face_;
    std::string broken_;
};

}  // namespace

Status validate(const Face& face) { return Validation(face).run(); }

}  // namespace blush
