// Laws of the transfer of vertices: what is open, what is hidden, and how it turns.

#include "rig/light/occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/test_faces.h"

namespace blush {
namespace {

constexpr double pi = std::numbers::pi;

/// Light that is not the same from any two sides.
Sh9Color some_light() {
    Sh9Color light{};
    for (std::size_t i = 0; i < 9; ++i) {
        const double k = static_cast<double>(i);
        light[i] = glm::dvec3(std::sin(1 + k), std::cos(2 * k), std::sin(3 + 2 * k)) * (i == 0 ? 1.0 : 0.2);
    }
    light[0] = glm::dvec3(3, 2.5, 2);
    return light;
}

TEST(Occlusion, AnOpenVertexHasTheClosedFormHoweverFewTheRays) {
    for (const std::uint32_t count : {1U, 16U, 512U}) {
        const std::vector<glm::dvec3> directions = cosine_directions(count);
        const LightTransfer open = transfer_of(directions, std::vector<std::uint8_t>(count, 0));
        const Sh9 closed = clamped_cosine({0, 0, 1});
        for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(open[i], static_cast<float>(closed[i]));
        EXPECT_NEAR(openness(open), 1, 1e-6);
    }
}

TEST(Occlusion, DirectionsCarryTheCosine) {
    constexpr std::uint32_t count = 512;
    glm::dvec3 sum(0);
    double squares = 0;
    for (const glm::dvec3& w : cosine_directions(count)) {
        EXPECT_NEAR(glm::length(w), 1, 1e-12);
        EXPECT_GT(w.z, 0);
        sum += w;
        squares += w.z * w.z;
    }
    // Means under the cosine: of z 2/3, of x and y 0, of z^2 1/2.
    EXPECT_NEAR(sum.z / count, 2.0 / 3, 1e-3);
    EXPECT_NEAR(sum.x / count, 0, 1e-3);
    EXPECT_NEAR(sum.y / count, 0, 1e-3);
    EXPECT_NEAR(squares / count, 0.5, 1e-3);
}

TEST(Occlusion, AHalfHiddenVertexHasHalfTheIntegral) {
    // A wall at x = 0 hides all that comes from x > 0: an integral over a quarter of the sphere, by fine steps.
    constexpr std::uint32_t count = 4096;
    const std::vector<glm::dvec3> directions = cosine_directions(count);
    std::vector<std::uint8_t> hidden;
    for (const glm::dvec3& w : directions) hidden.push_back(w.x > 0 ? 1 : 0);
    const LightTransfer half = transfer_of(directions, hidden);
    Sh9 exact{};
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double z = (i + 0.5) / steps, phi = pi * (0.5 + (j + 0.5) / steps), r = std::sqrt(1 - z * z);
            const Sh9 basis = sh_basis({r * std::cos(phi), r * std::sin(phi), z});
            for (std::size_t k = 0; k < 9; ++k) exact[k] += basis[k] * z * (1.0 / steps) * (pi / steps);
        }
    }
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(static_cast<double>(half[k]), exact[k], 2e-3) << k;
    EXPECT_NEAR(openness(half), 0.5, 2e-3);
}

TEST(Occlusion, EverythingHiddenIsDarkAndNothingExceedsAnOpenVertex) {
    constexpr std::uint32_t count = 512;
    const std::vector<glm::dvec3> directions = cosine_directions(count);
    const glm::dmat3 frame(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, -1))));
    const glm::dvec3 dark =
        occluded_ambient(some_light(), transfer_of(directions, std::vector<std::uint8_t>(count, 1)), frame);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(dark[c], 2e-3);

    Sh9Color white{};
    white[0] = glm::dvec3(1 / sh_basis({0, 0, 1})[0]);
    test::Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<std::uint8_t> hidden;
        const auto share = static_cast<float>(trial) / 200;
        for (std::uint32_t i = 0; i < count; ++i) hidden.push_back(random.between(0, 1) < share ? 1 : 0);
        const LightTransfer transfer = transfer_of(directions, hidden);
        const glm::dvec3 furnace = occluded_ambient(white, transfer, frame);
        EXPECT_LE(furnace.x, 1 + 1e-12);
        EXPECT_NEAR(furnace.x, openness(transfer), 1e-6);
        const glm::dvec3 here = occluded_ambient(some_light(), transfer, frame);
        const glm::dvec3 open = dot(some_light(), clamped_cosine(frame[2])) / pi;
        for (glm::length_t c = 0; c < 3; ++c) EXPECT_LE(here[c], std::max(0.0, open[c]) + 1e-12);
    }
}

TEST(Occlusion, BouncesKeepAWhiteFurnaceWhiteAndAddNothingWhereNothingHides) {
    for (const double open : {0.01, 0.3, 1.0}) {
        const glm::dvec3 light = with_bounces(glm::dvec3(open), open, {1, 0.5, 0});
        EXPECT_NEAR(light.x, 1, 1e-9);
        EXPECT_LE(light.y, 1);
        EXPECT_GE(light.y, open);
        EXPECT_NEAR(light.z, open, 1e-12);
    }
}

TEST(Occlusion, WhatComesFromEverySideArrivesThroughEveryOpening) {
    std::vector<std::uint8_t> hidden;
    const std::vector<glm::dvec3> directions = cosine_directions(256);
    for (const glm::dvec3& w : directions) hidden.push_back(w.x > -0.3 ? 1 : 0);
    const LightTransfer transfer = transfer_of(directions, hidden);
    Sh9Color lamp{};  // from the hidden side, so hard that the coefficients ring below 0
    const Sh9 from = sh_basis({0.9, 0, std::sqrt(1 - 0.81)});
    for (std::size_t i = 0; i < 9; ++i) lamp[i] = glm::dvec3(5 * from[i]);
    lamp[0] += glm::dvec3(0.2 / sh_basis({0, 0, 1})[0]);
    EXPECT_EQ(occluded_ambient(lamp, transfer, glm::dmat3(1)).x, 0);
    EXPECT_NEAR(occluded_ambient(lamp, transfer, glm::dmat3(1), glm::dvec3(0.2)).x, 0.2 * openness(transfer), 1e-12);
}

TEST(Occlusion, ShutVerticesTakeTheirNeighbours) {
    const LightTransfer open = transfer_of(cosine_directions(16), std::vector<std::uint8_t>(16, 0));
    std::vector<LightTransfer> transfers = {open, LightTransfer{}, LightTransfer{}, LightTransfer{}};
    // 0 - 1 - 2, and 3 that no triangle joins to anything open.
    fill_shut_vertices(std::vector<std::uint32_t>{0, 1, 1, 1, 2, 2, 3, 3, 3}, transfers);
    EXPECT_EQ(transfers[1], open);
    EXPECT_EQ(transfers[2], open);
    EXPECT_EQ(transfers[3], LightTransfer{});
}

TEST(Occlusion, TurningTheVertexIsTurningTheLightBack) {
    std::vector<std::uint8_t> hidden;
    const std::vector<glm::dvec3> directions = cosine_directions(256);
    for (const glm::dvec3& w : directions) hidden.push_back(w.x > 0.2 || w.y < -0.5 ? 1 : 0);
    const LightTransfer transfer = transfer_of(directions, hidden);
    const glm::dmat3 frame = vertex_frame(glm::normalize(glm::dvec3(0.2, 0.5, 1)), {1, 0, 0.1});
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.1, glm::normalize(glm::dvec3(-1, 0.3, 0.8))));
    const glm::dvec3 turned = occluded_ambient(some_light(), transfer, turn * frame);
    const glm::dvec3 back = occluded_ambient(rotate(sh_rotation(glm::transpose(turn)), some_light()), transfer, frame);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(turned[c], back[c], 1e-9);
}

TEST(Occlusion, FramesAreRightHandedWhateverTheTangent) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
    for (const glm::dvec3 tangent : {glm::dvec3(1, 0, 0), glm::dvec3(0), n, glm::dvec3(0, 1e-9, 0)}) {
        const glm::dmat3 frame = vertex_frame(n, tangent);
        EXPECT_NEAR(glm::determinant(frame), 1, 1e-12);
        EXPECT_NEAR(glm::length(frame[2] - n), 0, 1e-15);
    }
}

TEST(Occlusion, PosesShareOneAmongThem) {
    const Face face = test::make_face({.targets = 3});
    OcclusionSet set;
    set.poses = {{"", {}}, {"t1", {}}, {"t2", {}}};
    std::vector<float> out(3);
    occlusion_weights(set, face, std::vector<float>{1, 0.25F, 0.5F}, out);
    EXPECT_EQ(out, (std::vector<float>{0.25F, 0.25F, 0.5F}));
    occlusion_weights(set, face, std::vector<float>{0, std::nanf(""), 7}, out);
    EXPECT_EQ(out, (std::vector<float>{0, 0, 1}));
}

}  // namespace
}  // namespace blush
