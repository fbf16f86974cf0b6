#pragma once
/// Faces made by code, for tests that need no file: the same options give the same face, bit for bit.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "rig/deform/rest_frame.h"
#include "rig/face.h"

namespace blush::test {

/// Numbers from a seed, the same on every machine (splitmix64, Steele 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// low <= result < high
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(bits() >> 40) / 16777216.0F);
    }

private:
    std::uint64_t state_;
};

struct FaceOptions {
    std::uint32_t side = 20;  ///< vertices along each side of the dome
    std::uint32_t targets = 6;
    bool normal_deltas = false;        ///< targets bring NORMAL
    bool odd_without_normals = false;  ///< ... except every second one
    bool tangent_deltas = false;       ///< targets bring TANGENT
    bool two_primitives = false;       ///< left and right half; odd targets move the right one alone
    bool seam = false;                 ///< the middle column twice, with other texture coordinates
    bool normal_map = false;
    bool joints = false;  ///< two joints, blended from left to right
    std::uint64_t seed = 1;
};

inline void add_grid(Face& face, std::uint32_t columns, std::uint32_t rows, float x0, float x1, glm::vec2 uv0,
                     glm::vec2 uv1) {
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const float s = static_cast<float>(column) / static_cast<float>(columns - 1);
            const float t = static_cast<float>(row) / static_cast<float>(rows - 1);
            const float x = x0 + (x1 - x0) * s, y = -1 + 2 * t;
            const float z = 0.6F * (1 - 0.5F * (x * x + y * y)) + 0.05F * std::sin(5 * x) * std::cos(4 * y);
            face.positions.emplace_back(x, y, z);
            face.uv0.push_back(uv0 + (uv1 - uv0) * glm::vec2(s, t));
            face.uv1.emplace_back(0.0F);
        }
    }
    for (std::uint32_t row = 0; row + 1 < rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t a = first + row * columns + column, b = a + 1, c = a + columns, d = c + 1;
            face.indices.insert(face.indices.end(), {a, b, d, a, d, c});
        }
    }
}

inline void add_primitive(Face& face, std::uint32_t first_vertex, std::uint32_t first_index) {
    Primitive primitive;
    primitive.first_vertex = first_vertex;
    primitive.vertex_count = static_cast<std::uint32_t>(face.positions.size()) - first_vertex;
    primitive.first_index = first_index;
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size()) - first_index;
    primitive.material = face.materials.empty() ? -1 : 0;
    face.primitives.push_back(primitive);
}

/// Primitive::normal_source by its own definition.
inline void find_normal_sources(Face& face) {
    for (Primitive& primitive : face.primitives) {
        primitive.normal_source = NormalSource::rest;
        for (const Target& target : face.targets) {
            const bool moves = std::ranges::any_of(target.vertices, [&](std::uint32_t v) {
                return v >= primitive.first_vertex && v < primitive.first_vertex + primitive.vertex_count;
            });
            if (!moves || primitive.normal_source == NormalSource::recomputed) continue;
            primitive.normal_source = target.normal_deltas.empty() ? NormalSource::recomputed : NormalSource::authored;
        }
    }
}

/// A smooth local bulge: every vertex within `radius` of `centre` moves along `move`, less towards the rim.
inline Target bulge(const Face& face, std::string name, glm::vec3 centre, float radius, glm::vec3 move) {
    Target target;
    target.name = std::move(name);
    for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
        const float r = glm::length(face.positions[v] - centre) / radius;
        if (r >= 1) continue;
        const float share = (1 - r * r) * (1 - r * r);
        target.vertices.push_back(v);
        target.position_deltas.push_back(share * move);
    }
    return target;
}

/// Gives a target the NORMAL deltas that an authoring tool would: normals of the deformed surface less those at rest.
inline void add_normal_deltas(const Face& face, Target& target) {
    std::vector<glm::vec3> moved = face.positions;
    for (std::size_t i = 0; i < target.vertices.size(); ++i) moved[target.vertices[i]] += target.position_deltas[i];
    const std::vector<glm::vec3> normals = smooth_normals(moved, face.indices);
    target.normal_deltas.clear();
    for (const std::uint32_t v : target.vertices) target.normal_deltas.push_back(normals[v] - face.normals[v]);
}

inline void keep_vertices_from(Target& target, std::uint32_t first) {
    const auto at = std::ranges::lower_bound(target.vertices, first) - target.vertices.begin();
    target.vertices.erase(target.vertices.begin(), target.vertices.begin() + at);
    target.position_deltas.erase(target.position_deltas.begin(), target.position_deltas.begin() + at);
}

/// A shallow waffle as a tangent-space normal map.
inline Image waffle_normal_map() {
    Image image;
    image.name = "waffle";
    image.width = image.height = 16;
    image.channels = 3;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const glm::vec3 n = glm::normalize(glm::vec3(0.4F * std::sin(0.8F * static_cast<float>(x)),
                                                         0.4F * std::cos(0.8F * static_cast<float>(y)), 1.0F));
            for (glm::length_t c = 0; c < 3; ++c) {
                image.bytes.push_back(static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * n[c])));
            }
        }
    }
    return image;
}

inline void add_two_joints(Face& face) {
    for (const char* name : {"jointLeft", "jointRight"}) {
        Node joint;
        joint.name = name;
        joint.parent = 0;
        joint.rest.translation = {face.nodes.size() == 1 ? 0.5F : -0.5F, 0, 0};
        face.nodes.push_back(joint);
    }
    Skin skin;
    skin.joints = {1, 2};
    for (const std::uint32_t joint : skin.joints) {
        glm::mat4 inverse(1);
        inverse[3] = glm::vec4(-face.nodes[joint].rest.translation, 1);
        skin.joint_from_mesh.push_back(inverse);
    }
    face.skins.push_back(skin);
    face.nodes[0].mesh = -1;
    Node drawn;
    drawn.name = "drawn";
    drawn.parent = 0;
    drawn.mesh = 0;
    drawn.skin = 0;
    face.nodes.push_back(drawn);
    for (const glm::vec3 p : face.positions) {
        const float right = std::clamp(0.5F - 0.5F * p.x, 0.0F, 1.0F);
        face.joints.emplace_back(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{0}, std::uint16_t{0});
        face.joint_weights.emplace_back(1 - right, right, 0, 0);
    }
}

/// A bumpy dome two units across that looks along +Z, with sparse targets "t0", "t1", ... Satisfies validate().
inline Face make_face(const FaceOptions& options = {}) {
    Face face;
    face.path = "test_face";
    Material material;
    material.name = "skin";
    material.base_color_linear = {0.8F, 0.5F, 0.4F, 1};
    material.metallic = 0;
    material.roughness = 0.45F;
    if (options.normal_map) {
        face.images.push_back(waffle_normal_map());
        material.normal.image = 0;
    }
    face.materials.push_back(material);

    const std::uint32_t side = options.side, half = (side + 1) / 2;
    std::uint32_t right_half = 0;
    if (options.two_primitives || options.seam) {
        add_grid(face, half, side, -1, 0, {0, 0}, {0.5F, 1});
        right_half = static_cast<std::uint32_t>(face.positions.size());
        if (options.two_primitives) add_primitive(face, 0, 0);
        const auto first_index = static_cast<std::uint32_t>(face.indices.size());
        add_grid(face, half, side, 0, 1, {0.5F, 0}, {1, 1});
        if (options.two_primitives) {
            add_primitive(face, right_half, first_index);
        } else {
            add_primitive(face, 0, 0);
        }
    } else {
        add_grid(face, side, side, -1, 1, {0, 0}, {1, 1});
        add_primitive(face, 0, 0);
    }
    face.normals = smooth_normals(face.positions, face.indices);
    face.tangents = tangents_from_uv(face.positions, face.normals, face.uv0, face.indices);
    face.meshes.push_back({"dome", 0, static_cast<std::uint32_t>(face.primitives.size())});
    Node node;
    node.name = "head";
    node.mesh = 0;
    face.nodes.push_back(node);

    Random random(options.seed);
    for (std::uint32_t t = 0; t < options.targets; ++t) {
        const glm::vec3 centre(random.between(-0.8F, 0.8F), random.between(-0.8F, 0.8F), 0.4F);
        const glm::vec3 move(random.between(-0.1F, 0.1F), random.between(-0.1F, 0.1F), random.between(-0.2F, 0.2F));
        Target target = bulge(face, "t" + std::to_string(t), centre, random.between(0.3F, 0.9F), move);
        if (options.two_primitives && t % 2 == 1) keep_vertices_from(target, right_half);
        if (options.normal_deltas && !(options.odd_without_normals && t % 2 == 1)) add_normal_deltas(face, target);
        if (options.tangent_deltas) {
            for (const glm::vec3 delta : target.position_deltas) {
                target.tangent_deltas.push_back(glm::vec3(0.3F * delta.z, 0, delta.x));
            }
        }
        face.targets.push_back(std::move(target));
    }
    find_normal_sources(face);
    if (options.joints) add_two_joints(face);
    return face;
}

/// Weights that differ from target to target: `count` of them not zero, spread over all targets of the face.
inline std::vector<float> spread_weights(const Face& face, std::size_t count, std::uint64_t seed = 7) {
    std::vector<float> weights(face.targets.size(), 0.0F);
    Random random(seed);
    count = std::min(count, weights.size());
    for (std::size_t i = 0; i < count; ++i) {
        const float weight = random.between(0.2F, 1.0F) * (i % 5 == 4 ? -0.5F : 1.0F);
        weights[i * weights.size() / count] = weight / std::max(1.0F, 0.1F * static_cast<float>(count));
    }
    return weights;
}

}  // namespace blush::test
