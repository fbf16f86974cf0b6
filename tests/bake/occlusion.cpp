// What Embree finds hidden, against shapes whose answer is known and against rays cast one by one.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rig/deform/rest_frame.h"
#include "runtime/bake/bake_occlusion.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

/// A face of one primitive of a height field z = f(x, y) over [-1, 1]^2.
template <class Height>
Face field(std::uint32_t side, Height height) {
    Face face = test::make_face({.side = side, .targets = 0});
    for (glm::vec3& p : face.positions) p.z = height(p.x, p.y);
    face.normals = smooth_normals(face.positions, face.indices);
    face.tangents = tangents_from_uv(face.positions, face.normals, face.uv0, face.indices);
    return face;
}

OcclusionSet baked(const Face& face, std::uint32_t rays = 256, std::vector<std::string> targets = {}) {
    Result<OcclusionSet> set = bake_occlusion(face, {rays, std::move(targets)});
    EXPECT_TRUE(set) << (set ? "" : set.error().message);
    return set ? *std::move(set) : OcclusionSet{};
}

void expect_open(const LightTransfer& transfer, std::size_t vertex) {
    const Sh9 open = clamped_cosine({0, 0, 1});
    for (std::size_t i = 0; i < 9; ++i) ASSERT_EQ(transfer[i], static_cast<float>(open[i])) << "vertex " << vertex;
}

TEST(BakeOcclusion, AnOpenPlaneIsOpen) {
    const OcclusionSet set = baked(field(12, [](float, float) { return 0.0F; }));
    for (std::size_t v = 0; v < set.poses[0].transfers.size(); ++v) expect_open(set.poses[0].transfers[v], v);
}

TEST(BakeOcclusion, AConvexSphereIsOpen) {
    // A dome: the cap of a sphere of radius 2.
    const OcclusionSet set = baked(field(24, [](float x, float y) { return std::sqrt(4 - x * x - y * y); }));
    for (std::size_t v = 0; v < set.poses[0].transfers.size(); ++v) expect_open(set.poses[0].transfers[v], v);
}

TEST(BakeOcclusion, APitIsDarkerThanARidgeAndLitFromItsOpening) {
    const Face face = field(41, [](float x, float) { return 0.3F * std::cos(9.42477796F * x); });
    const OcclusionSet set = baked(face);
    double pit = 1, ridge = 0;
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        if (std::abs(face.positions[v].y) > 0.3F || std::abs(face.positions[v].x) > 0.7F) continue;
        const double open = openness(set.poses[0].transfers[v]);
        if (face.positions[v].z < -0.29F) pit = std::min(pit, open);
        if (face.positions[v].z > 0.29F) ridge = std::max(ridge, open);
    }
    EXPECT_LT(pit, 0.75);
    EXPECT_GT(ridge, 0.99);
}

/// Moeller and Trumbore 1997, in double precision.
bool meets(glm::dvec3 origin, glm::dvec3 along, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(along, ac);
    const double det = glm::dot(ab, p);
    if (std::abs(det) < 1e-14) return false;
    const glm::dvec3 s = (origin - a) / det;
    const double u = glm::dot(s, p);
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(along, q), t = glm::dot(ac, q);
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0;
}

TEST(BakeOcclusion, EmbreeFindsWhatEveryTriangleByItselfDoes) {
    const Face face = field(14, [](float x, float y) { return 0.35F * std::sin(5 * x) * std::cos(4 * y); });
    constexpr std::uint32_t rays = 64;
    const OcclusionSet set = baked(face, rays);
    const std::vector<glm::dvec3> directions = cosine_directions(rays);
    glm::vec3 low(9), high(-9);
    for (const glm::vec3& p : face.positions) low = glm::min(low, p), high = glm::max(high, p);
    const double lift = 4e-4 * static_cast<double>(glm::length(high - low));  // the baker's
    std::size_t differ = 0, all = 0;
    for (std::size_t v = 0; v < face.positions.size(); v += 5) {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(face.normals[v]));
        const glm::dmat3 frame = vertex_frame(normal, glm::dvec3(face.tangents[v]));
        const glm::dvec3 origin = glm::dvec3(face.positions[v]) + lift * normal;
        std::vector<std::uint8_t> hidden;
        for (const glm::dvec3& w : directions) {
            bool met = false;
            for (std::size_t i = 0; i < face.indices.size() && !met; i += 3) {
                met = meets(origin, frame * w, face.positions[face.indices[i]], face.positions[face.indices[i + 1]],
                            face.positions[face.indices[i + 2]]);
            }
            hidden.push_back(met ? 1 : 0);
        }
        const LightTransfer twin = transfer_of(directions, hidden);
        ++all;
        for (std::size_t i = 0; i < 9; ++i) {
            // One ray that grazes an edge may fall on either side in single precision.
            if (std::abs(twin[i] - set.poses[0].transfers[v][i]) > 1e-5F) {
                ++differ;
                break;
            }
        }
    }
    EXPECT_GT(all, 30U);
    EXPECT_LE(differ, 1U);
}

TEST(BakeOcclusion, CardsHideNothingAndPosesHaveTheirOwn) {
    Face face = field(12, [](float, float) { return 0.0F; });
    // A roof over the plane, of its own material.
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    const auto first_index = static_cast<std::uint32_t>(face.indices.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        face.positions.emplace_back(corner, 0.2F);
        face.normals.emplace_back(0.0F, 0.0F, 1.0F);
        face.tangents.emplace_back(1.0F, 0.0F, 0.0F, 1.0F);
        face.uv0.emplace_back(0.0F);
        face.uv1.emplace_back(0.0F);
    }
    face.indices.insert(face.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    test::add_primitive(face, first, first_index);
    face.meshes[0].primitive_count = 2;
    face.primitives[1].material = 1;
    face.materials.push_back(face.materials[0]);
    Target away;  // lifts the roof far off
    away.name = "away";
    for (std::uint32_t i = 0; i < 4; ++i) {
        away.vertices.push_back(first + i);
        away.position_deltas.emplace_back(0.0F, 0.0F, 1e4F);
    }
    face.targets.push_back(away);
    const std::size_t middle = 5 * 12 + 5;
    OcclusionSet set = baked(face, 256, {"away"});
    EXPECT_LT(openness(set.poses[0].transfers[middle]), 0.1);
    EXPECT_GT(openness(set.poses[1].transfers[middle]), 0.99);
    face.materials[1].alpha_mode = AlphaMode::mask;
    set = baked(face);
    EXPECT_EQ(openness(set.poses[0].transfers[middle]), openness(set.poses[0].transfers[0]));
}

TEST(BakeOcclusion, TheSameFaceGivesTheSameNumbers) {
    const Face face = test::make_face({.side = 16, .targets = 1});
    const OcclusionSet a = baked(face, 64, {"t0"}), b = baked(face, 64, {"t0"});
    ASSERT_EQ(a.poses.size(), 2U);
    EXPECT_EQ(a.face_identity, b.face_identity);
    for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(a.poses[p].transfers, b.poses[p].transfers);
    EXPECT_NE(a.poses[0].transfers, a.poses[1].transfers);
}

TEST(BakeOcclusion, WhatCannotBeIsNamed) {
    const Face face = test::make_face({.side = 4, .targets = 1});
    const Result<OcclusionSet> none = bake_occlusion(face, {16, {"nothing"}});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "test_face: it has no target \"nothing\"");
    const Result<OcclusionSet> many = bake_occlusion(face, {16, std::vector<std::string>(8, "t0")});
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().message, "test_face: 8 poses beside rest; 7 are taken at most");
    // A face without a triangle: everything is open.
    Face bare = face;
    bare.indices.clear();
    bare.primitives[0].index_count = 0;
    expect_open(baked(bare).poses[0].transfers[0], 0);
}

}  // namespace
}  // namespace blush
