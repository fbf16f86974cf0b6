#include "rig/head/rigid_fit.h"

#include <gtest/gtest.h>

#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/test_faces.h"

namespace blush {
namespace {

double farthest(const glm::dmat4& a, const glm::dmat4& b) {
    double worst = 0;
    for (glm::length_t c = 0; c < 4; ++c) {
        for (glm::length_t r = 0; r < 4; ++r) worst = std::max(worst, std::abs(a[c][r] - b[c][r]));
    }
    return worst;
}

glm::dvec3 any(test::Random& random) {
    const auto one = [&random] { return static_cast<double>(random.between(-1, 1)); };
    return {one(), one(), one()};
}

TEST(RigidFit, FindsEveryRigidMotion) {
    test::Random random(3);
    for (int round = 0; round < 1000; ++round) {
        std::vector<glm::dvec3> from, to;
        std::vector<double> weights;
        const double angle = static_cast<double>(random.between(-3.1415F, 3.1415F));
        const glm::dmat4 motion = glm::translate(glm::dmat4(1), 5.0 * any(random)) *
                                  glm::rotate(glm::dmat4(1), angle, glm::normalize(any(random) + 1e-3));
        for (int i = 0; i < 4 + round % 40; ++i) {
            from.push_back(any(random));
            to.emplace_back(motion * glm::dvec4(from.back(), 1));
            weights.push_back(static_cast<double>(random.between(0.1F, 1)));
        }
        ASSERT_LT(farthest(fit_rigid(from, to, weights), motion), 1e-12) << round;
    }
}

TEST(RigidFit, IsTheBestThereIs) {
    test::Random random(4);
    std::vector<glm::dvec3> from, to;
    std::vector<double> weights;
    for (int i = 0; i < 20; ++i) {
        from.push_back(any(random));
        to.push_back(from.back() + 0.2 * any(random));
        weights.push_back(static_cast<double>(random.between(0.1F, 1)));
    }
    const auto error = [&](const glm::dmat4& motion) {
        double sum = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const glm::dvec3 off = glm::dvec3(motion * glm::dvec4(from[i], 1)) - to[i];
            sum += weights[i] * glm::dot(off, off);
        }
        return sum;
    };
    const glm::dmat4 best = fit_rigid(from, to, weights);
    EXPECT_NEAR(glm::determinant(glm::dmat3(best)), 1, 1e-14);
    for (int round = 0; round < 1000; ++round) {
        const glm::dmat4 nudge =
            glm::translate(glm::dmat4(1), 0.01 * any(random)) *
            glm::rotate(glm::dmat4(1), 0.01 * static_cast<double>(random.between(-1, 1)), glm::normalize(any(random)));
        EXPECT_GE(error(nudge * best), error(best));
    }
}

TEST(RigidFit, WithoutAShapeNothingTurns) {
    const std::vector<glm::dvec3> point(5, glm::dvec3(1, 2, 3)), moved(5, glm::dvec3(1, 2, 4));
    const std::vector<double> one(5, 1), none(5, 0);
    EXPECT_LT(farthest(fit_rigid(point, moved, one), glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 1))), 1e-15);
    EXPECT_EQ(farthest(fit_rigid(point, moved, none), glm::dmat4(1)), 0);
    // A mirror is no motion.
    std::vector<glm::dvec3> corners, mirrored;
    for (int i = 0; i < 8; ++i) {
        corners.emplace_back(i & 1, (i & 2) / 2, (i & 4) / 4);
        mirrored.emplace_back(-corners.back().x, corners.back().y, corners.back().z);
    }
    EXPECT_NEAR(glm::determinant(glm::dmat3(fit_rigid(corners, mirrored, std::vector<double>(8, 1)))), 1, 1e-12);
}

}  // namespace
}  // namespace blush
