// The CPU deformation against its laws and its exact twin.

#include "rig/deform/deform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/deform_exact.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

using test::FaceOptions;
using test::make_face;

// Positions: 1e-6 of the head's size; a test face is two units across.
constexpr double position_tolerance = 1e-6 * 2;
// Recomputed normals: the cross products of a fan cancel to about a hundredth of their terms' size here, so an error of
// 6e-8 (half a unit in the last place of 1) of a position grows to some 1e-5 radians of a normal.
constexpr double normal_tolerance_millidegrees = 0.6;

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

double millidegrees_between(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180'000 / std::numbers::pi;
}

double worst_position_error(const Face& face, const std::vector<float>& weights, const DeformedSurface& surface) {
    const ExactSurface exact = deform_exact(face, weights);
    double worst = 0;
    for (std::size_t v = 0; v < exact.positions.size(); ++v) {
        worst = std::max(worst, glm::distance(glm::dvec3(surface.positions[v]), exact.positions[v]));
    }
    return worst;
}

double worst_normal_error_millidegrees(const Face& face, const std::vector<float>& weights,
                                       const DeformedSurface& surface) {
    const ExactSurface exact = deform_exact(face, weights);
    double worst = 0;
    for (std::size_t v = 0; v < exact.normals.size(); ++v) {
        worst = std::max(worst, millidegrees_between(glm::dvec3(surface.normals[v]), exact.normals[v]));
    }
    return worst;
}

/// Unit normals and tangents, finite positions, in every vertex.
void expect_sound(const DeformedSurface& surface) {
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
        for (glm::length_t c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(surface.positions[v][c])) << "vertex " << v;
        ASSERT_NEAR(glm::length(glm::dvec3(surface.normals[v])), 1, 1e-6) << "vertex " << v;
        ASSERT_NEAR(glm::length(glm::dvec3(surface.tangents[v])), 1, 1e-6) << "vertex " << v;
        ASSERT_EQ(std::abs(surface.tangents[v].w), 1) << "vertex " << v;
    }
}

/// Replaces the targets of a face by one without NORMAL deltas that puts each vertex where `place` says.
template <class Place>
void move_all(Face& face, Place place) {
    Target target;
    target.name = "all";
    for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
        target.vertices.push_back(v);
        target.position_deltas.push_back(place(face.positions[v]) - face.positions[v]);
    }
    face.targets = {target};
    test::find_normal_sources(face);
}

DeformedSurface deformed(const Face& face, const std::vector<float>& weights, NormalMethod method) {
    Deformer deformer(face);
    DeformedSurface surface;
    deformer.deform(weights, method, surface);
    return surface;
}

TEST(Deformer, ZeroWeightsGiveTheRestFaceBitForBit) {
    const Face face = make_face({.targets = 5, .normal_deltas = true, .tangent_deltas = true, .seam = true});
    Deformer deformer(face);
    DeformedSurface surface;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        deformer.deform(std::vector<float>{1, 1, 1, 1, 1}, method, surface);
        EXPECT_FALSE(same_bits(surface.positions, face.positions));
        deformer.deform(std::vector<float>{0, -0.0F, nan, 0, 0}, method, surface);
        EXPECT_TRUE(same_bits(surface.positions, face.positions));
        EXPECT_TRUE(same_bits(surface.normals, face.normals));
        EXPECT_TRUE(same_bits(surface.tangents, face.tangents));
    }
}

TEST(Deformer, AgreesWithTheExactTwin) {
    double worst_normal = 0;
    for (const bool normal_deltas : {false, true}) {
        const Face face =
            make_face({.side = 40, .targets = 12, .normal_deltas = normal_deltas, .two_primitives = true});
        for (const float weight : {0.5F, 1.0F, -0.7F}) {
            const std::vector<float> weights(face.targets.size(), weight);
            const DeformedSurface surface = deformed(face, weights, NormalMethod::recomputed);
            EXPECT_LE(worst_position_error(face, weights, surface), position_tolerance) << "weight " << weight;
            worst_normal = std::max(worst_normal, worst_normal_error_millidegrees(face, weights, surface));
            expect_sound(surface);
        }
    }
    RecordProperty("worst_normal_millidegrees", std::to_string(worst_normal));
    EXPECT_LE(worst_normal, normal_tolerance_millidegrees);
}

TEST(Deformer, AuthoredNormalsArriveAtWhatTheAuthorGaveAtFullWeight) {
    const Face face = make_face({.targets = 1, .normal_deltas = true});
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    std::vector<glm::vec3> moved = face.positions;
    for (std::size_t i = 0; i < face.targets[0].vertices.size(); ++i) {
        moved[face.targets[0].vertices[i]] += face.targets[0].position_deltas[i];
    }
    const std::vector<glm::vec3> normals = smooth_normals(moved, face.indices);
    double worst = 0, furthest = 0;
    for (const std::uint32_t v : face.targets[0].vertices) {
        worst = std::max(worst, millidegrees_between(surface.normals[v], normals[v]));
        furthest = std::max(furthest, millidegrees_between(face.normals[v], normals[v]));
    }
    EXPECT_GT(furthest, 1000);  // the target does turn them, by more than a degree
    EXPECT_LE(worst, normal_tolerance_millidegrees);
    expect_sound(surface);
}

TEST(Deformer, TakesEachPrimitivesNormalsFromWhereItSays) {
    Face face = make_face({.targets = 4, .normal_deltas = true, .odd_without_normals = true, .two_primitives = true});
    ASSERT_EQ(face.primitives[0].normal_source, NormalSource::authored);
    ASSERT_EQ(face.primitives[1].normal_source, NormalSource::recomputed);
    // Unmistakable NORMAL deltas, which only the first primitive may use.
    for (glm::vec3& delta : face.targets[0].normal_deltas) delta = {5, 0, 0};
    const std::vector<float> weights = {1, 0, 0, 0};
    const DeformedSurface authored = deformed(face, weights, NormalMethod::authored);
    const DeformedSurface recomputed = deformed(face, weights, NormalMethod::recomputed);
    std::size_t on_left = 0, on_right = 0;
    for (const std::uint32_t v : face.targets[0].vertices) {
        const bool left = v < face.primitives[1].first_vertex;
        (left ? on_left : on_right)++;
        EXPECT_EQ(authored.normals[v].x > 0.9F, left) << "vertex " << v;
        EXPECT_LT(recomputed.normals[v].x, 0.9F) << "vertex " << v;
    }
    EXPECT_GT(on_left, 0U);
    EXPECT_GT(on_right, 0U);
}

TEST(Deformer, TurnsNormalsExactlyWithARigidRotation) {
    for (const float degrees : {30.0F, 90.0F, 170.0F}) {
        Face face = make_face({.targets = 0, .seam = true});
        const auto turn =
            glm::mat3(glm::rotate(glm::mat4(1), glm::radians(degrees), glm::normalize(glm::vec3(1, 2, 3))));
        move_all(face, [&](glm::vec3 p) { return turn * p; });
        const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
        expect_sound(surface);
        // The shortest arc between the fan's two normals is the rotation itself where the rest normal is the fan's.
        for (std::size_t v = 0; v < face.positions.size(); ++v) {
            const glm::dvec3 expected = glm::dmat3(turn) * glm::dvec3(face.normals[v]);
            ASSERT_LE(millidegrees_between(surface.normals[v], expected), normal_tolerance_millidegrees)
                << degrees << " degrees, vertex " << v;
        }
    }
}

TEST(Deformer, KeepsHardEdgesHard) {
    // A roof of two quads that share the ridge's positions but not their normals, lifted at the ridge.
    Face face = make_face({.side = 2, .targets = 0});
    face.positions = {{-1, 0, 0}, {0, 1, 0}, {-1, 0, 1}, {0, 1, 1}, {0, 1, 0}, {1, 0, 0}, {0, 1, 1}, {1, 0, 1}};
    face.indices = {0, 2, 1, 1, 2, 3, 4, 6, 5, 5, 6, 7};
    const glm::vec3 left = glm::normalize(glm::vec3(-1, 1, 0)), right = glm::normalize(glm::vec3(1, 1, 0));
    face.normals = {left, left, left, left, right, right, right, right};
    face.tangents.assign(8, glm::vec4(0, 0, 1, 1));
    face.uv0.assign(8, glm::vec2(0));
    face.uv1 = face.uv0;
    face.primitives[0].vertex_count = 8;
    face.primitives[0].index_count = 12;
    move_all(face, [](glm::vec3 p) { return glm::vec3(p.x, p.y * std::sqrt(3.0F), p.z); });
    ASSERT_TRUE(validate(face));

    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    const glm::dvec3 steep_left(-std::sqrt(3.0) / 2, 0.5, 0), steep_right(std::sqrt(3.0) / 2, 0.5, 0);
    for (std::size_t v = 0; v < 8; ++v) {
        EXPECT_LE(millidegrees_between(surface.normals[v], v < 4 ? steep_left : steep_right), 0.05) << "vertex " << v;
    }
}

TEST(Deformer, GivesBothSidesOfASeamTheSameNormal) {
    const Face face = make_face({.side = 20, .targets = 3, .seam = true});
    const DeformedSurface surface = deformed(face, {1, 0.4F, -0.5F}, NormalMethod::authored);
    std::size_t pairs = 0, moved = 0;
    for (std::size_t a = 0; a < face.positions.size(); ++a) {
        for (std::size_t b = a + 1; b < face.positions.size(); ++b) {
            if (face.positions[a] != face.positions[b]) continue;
            ++pairs;
            moved += surface.normals[a] != face.normals[a] ? 1U : 0U;
            EXPECT_EQ(surface.normals[a], surface.normals[b]);
        }
    }
    EXPECT_EQ(pairs, 20U);
    EXPECT_GT(moved, 5U);
}

TEST(Deformer, TangentsStayAtRightAnglesToNormals) {
    const Face face = make_face({.targets = 6, .normal_deltas = true, .tangent_deltas = true});
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        const DeformedSurface surface = deformed(face, std::vector<float>(6, 0.8F), method);
        expect_sound(surface);
        std::size_t changed = 0;
        for (std::size_t v = 0; v < face.positions.size(); ++v) {
            changed += surface.tangents[v] != face.tangents[v] ? 1U : 0U;
            EXPECT_NEAR(glm::dot(glm::vec3(surface.tangents[v]), surface.normals[v]), 0, 1e-5F);
            EXPECT_EQ(surface.tangents[v].w, face.tangents[v].w);
        }
        EXPECT_GT(changed, face.positions.size() / 4);
    }
}

// --- degenerate fans, by name ---------------------------------------------------------------------------------------

TEST(DegenerateFans, CollapsedToAPointTheyKeepTheRestNormal) {
    Face face = make_face({.targets = 0});
    for (Primitive& primitive : face.primitives) primitive.normal_source = NormalSource::recomputed;
    move_all(face, [](glm::vec3) { return glm::vec3(0); });
    // A delta is rounded, so that some vertices land a rounding error beside the point: those have a direction of
    // noise.
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    EXPECT_TRUE(same_bits(surface.normals, face.normals));
}

TEST(DegenerateFans, FlattenedToAPlaneTheyTakeThePlanesNormal) {
    Face face = make_face({.targets = 0});
    face.normals = smooth_normals(face.positions, face.indices);
    move_all(face, [](glm::vec3 p) { return glm::vec3(p.x, p.y, 0); });
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    for (const glm::vec3 normal : surface.normals) ASSERT_LE(millidegrees_between(normal, {0, 0, 1}), 50);
}

TEST(DegenerateFans, MirroredTheyFollowTheSurfaceTurnedOver) {
    Face face = make_face({.targets = 0});
    move_all(face, [](glm::vec3 p) { return glm::vec3(-p.x, p.y, p.z); });
    const std::vector<float> weights = {1};
    const DeformedSurface surface = deformed(face, weights, NormalMethod::authored);
    expect_sound(surface);
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        // The triangles' winding turns over with the mirror, so the outside is now on the other side.
        const glm::dvec3 mirrored(face.normals[v].x, -face.normals[v].y, -face.normals[v].z);
        ASSERT_LE(millidegrees_between(surface.normals[v], mirrored), normal_tolerance_millidegrees) << v;
    }
}

TEST(DegenerateFans, HalfATurnTakesTheDeformedSurfacesNormal) {
    Face face = make_face({.targets = 0});
    for (glm::vec3& p : face.positions) p.z = 0;
    face.normals.assign(face.normals.size(), {0, 0, 1});
    face.tangents.assign(face.tangents.size(), {1, 0, 0, 1});
    move_all(face, [](glm::vec3 p) { return glm::vec3(-p.x, p.y, 0); });
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    for (const glm::vec3 normal : surface.normals) ASSERT_LE(millidegrees_between(normal, {0, 0, -1}), 0.05);
}

TEST(DegenerateFans, WithoutAreaAtRestTheyKeepTheRestNormal) {
    Face face = make_face({.targets = 0});
    for (std::size_t i = 0; i < face.indices.size(); i += 3) face.indices[i + 1] = face.indices[i];
    move_all(face, [](glm::vec3 p) { return glm::vec3(2 * p.x, p.y, p.z); });
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    EXPECT_TRUE(same_bits(surface.normals, face.normals));
}

// Cards of hair have triangles for both sides at the same vertices.
TEST(DegenerateFans, OfBothSidesKeepTheRestNormal) {
    Face face = make_face({.targets = 0});
    const std::vector<std::uint32_t> front = face.indices;
    for (std::size_t i = 0; i < front.size(); i += 3) {
        face.indices.insert(face.indices.end(), {front[i], front[i + 2], front[i + 1]});
    }
    face.primitives[0].index_count = static_cast<std::uint32_t>(face.indices.size());
    move_all(face, [](glm::vec3 p) { return glm::vec3(p.x + 0.3F * p.y, 1.1F * p.y, p.z - 0.4F * p.x); });
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    EXPECT_TRUE(same_bits(surface.normals, face.normals));
}

TEST(DegenerateFans, OfVerticesThatNoTriangleUsesKeepTheRestNormal) {
    Face face = make_face({.targets = 1});
    face.primitives[0].index_count = 0;
    face.indices.clear();
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    EXPECT_TRUE(same_bits(surface.normals, face.normals));
    EXPECT_FALSE(same_bits(surface.positions, face.positions));
}

TEST(DegenerateFans, ANormalSumOfZeroKeepsTheRestNormal) {
    Face face = make_face({.targets = 1, .normal_deltas = true});
    Target& target = face.targets[0];
    for (std::size_t i = 0; i < target.vertices.size(); ++i) {
        target.normal_deltas[i] = -face.normals[target.vertices[i]];
    }
    const DeformedSurface surface = deformed(face, {1}, NormalMethod::authored);
    expect_sound(surface);
    EXPECT_TRUE(same_bits(surface.normals, face.normals));
}

TEST(Deformer, GivesTheSameNormalsAtEverySizeOfHead) {
    // Metres, centimetres and micrometres of the same head: powers of two, so that positions scale exactly.
    const Face face = make_face({.side = 30, .targets = 4});
    const DeformedSurface at_one = deformed(face, {1, 1, 1, 1}, NormalMethod::authored);
    for (const int exponent : {-20, -7, 7, 20}) {
        Face scaled = face;
        for (glm::vec3& p : scaled.positions) p *= std::ldexp(1.0F, exponent);
        for (Target& target : scaled.targets) {
            for (glm::vec3& delta : target.position_deltas) delta *= std::ldexp(1.0F, exponent);
        }
        const DeformedSurface surface = deformed(scaled, {1, 1, 1, 1}, NormalMethod::authored);
        double worst = 0;
        for (std::size_t v = 0; v < face.positions.size(); ++v) {
            worst = std::max(worst, millidegrees_between(surface.normals[v], at_one.normals[v]));
        }
        EXPECT_LE(worst, normal_tolerance_millidegrees) << "scaled by 2^" << exponent;
    }
}

// --- joints ---------------------------------------------------------------------------------------------------------

struct Skinned {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
};

Skinned skinned(const Face& face, const std::vector<glm::mat4>& joints) {
    Skinned result{face.positions, face.normals, face.tangents};
    skin(face.joints, face.joint_weights, joints, result.positions, result.normals, result.tangents);
    return result;
}

TEST(Skin, TheIdentityMovesNothing) {
    const Face face = make_face({.joints = true});
    const Skinned result = skinned(face, {glm::mat4(1), glm::mat4(1)});
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        ASSERT_LE(glm::distance(result.positions[v], face.positions[v]), 1e-6F);
        ASSERT_LE(glm::distance(result.normals[v], face.normals[v]), 1e-6F);
    }
}

TEST(Skin, ARigidMotionOfAllJointsIsThatMotion) {
    const Face face = make_face({.joints = true});
    const glm::mat4 motion = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(3, -1, 2)), 0.8F, glm::vec3(0, 1, 0));
    const Skinned result = skinned(face, {motion, motion});
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        ASSERT_LE(glm::distance(result.positions[v], glm::vec3(motion * glm::vec4(face.positions[v], 1))), 2e-6F);
        ASSERT_LE(glm::distance(result.normals[v], glm::mat3(motion) * face.normals[v]), 1e-6F);
        ASSERT_LE(glm::distance(glm::vec3(result.tangents[v]), glm::mat3(motion) * glm::vec3(face.tangents[v])), 1e-6F);
    }
}

TEST(Skin, ZeroWeightsLeaveTheVertexBitForBit) {
    Face face = make_face({.joints = true});
    std::ranges::fill(face.joint_weights, glm::vec4(0));
    const Skinned result = skinned(face, {glm::mat4(5), glm::mat4(7)});
    EXPECT_TRUE(same_bits(result.positions, face.positions));
    EXPECT_TRUE(same_bits(result.normals, face.normals));
    EXPECT_TRUE(same_bits(result.tangents, face.tangents));
}

TEST(Skin, BlendsTwoJointsByTheirWeights) {
    const Face face = make_face({.joints = true});
    const Skinned result = skinned(
        face, {glm::translate(glm::mat4(1), glm::vec3(0, 1, 0)), glm::translate(glm::mat4(1), glm::vec3(0, 0, 1))});
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        const glm::vec3 moved(0, face.joint_weights[v].x, face.joint_weights[v].y);
        ASSERT_LE(glm::distance(result.positions[v], face.positions[v] + moved), 1e-6F);
    }
}

TEST(Skin, AMatrixOfZeroKeepsUnitNormals) {
    const Face face = make_face({.joints = true});
    const Skinned result = skinned(face, {glm::mat4(0), glm::mat4(0)});
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        ASSERT_EQ(result.positions[v], glm::vec3(0));
        ASSERT_EQ(result.normals[v], face.normals[v]);
    }
}

}  // namespace
}  // namespace blush
