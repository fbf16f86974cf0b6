#include "rig/deform/pinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "rig/deform/open_borders.h"
#include "rig/deform/rest_places.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

std::vector<OpenBorder> borders_of(const Face& face) {
    return open_borders(face, std::vector<std::uint8_t>(face.primitives.size(), 1), rest_places(face, glm::dvec3(0)));
}

std::vector<std::uint32_t> neck_of(const Face& face) {
    return neck_border(face, std::vector<std::uint8_t>(face.primitives.size(), 1), rest_places(face, glm::dvec3(0)));
}

TEST(OpenBorders, GoRoundTheEdgeOnceWhateverSeamsCutIt) {
    for (const bool cut : {false, true}) {
        const Face face = test::make_face({.side = 21, .targets = 0, .two_primitives = cut, .seam = cut});
        const std::vector<OpenBorder> borders = borders_of(face);
        ASSERT_EQ(borders.size(), 1U);
        EXPECT_EQ(borders[0].vertices.size(), 80U);
        const std::set<std::uint32_t> once(borders[0].vertices.begin(), borders[0].vertices.end());
        EXPECT_EQ(once.size(), 80U);
        for (const std::uint32_t v : borders[0].vertices) {
            const glm::vec3 p = face.positions[v];
            EXPECT_TRUE(std::abs(p.x) == 1 || std::abs(p.y) == 1);
        }
        EXPECT_EQ(neck_of(face), borders[0].vertices);
    }
}

TEST(OpenBorders, TheNecksIsTheLowestOfTheLongOnes) {
    // Two windows: a small one below a large one, in a dome with an outer border of its own.
    Face face = test::make_face({.side = 21, .targets = 0});
    const auto cut = [&face](glm::vec2 low, glm::vec2 high) {
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < face.indices.size(); i += 3) {
            const glm::vec3 middle = (face.positions[face.indices[i]] + face.positions[face.indices[i + 1]] +
                                      face.positions[face.indices[i + 2]]) /
                                     3.0F;
            const bool inside = middle.x > low.x && middle.x < high.x && middle.y > low.y && middle.y < high.y;
            if (!inside)
                kept.insert(kept.end(), face.indices.begin() + static_cast<std::ptrdiff_t>(i),
                            face.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
        }
        face.indices = kept;
        face.primitives[0].index_count = static_cast<std::uint32_t>(kept.size());
    };
    cut({-0.2F, -0.8F}, {0.2F, -0.6F});
    std::vector<OpenBorder> borders = borders_of(face);
    ASSERT_EQ(borders.size(), 2U);
    EXPECT_EQ(neck_of(face).size(), 80U) << "a small one does not count";
    cut({-0.8F, -0.9F}, {0.8F, 0.1F});
    borders = borders_of(face);
    ASSERT_EQ(borders.size(), 2U);
    EXPECT_LT(neck_of(face).size(), 80U) << "long enough, and lower";
    face.indices.clear();
    face.primitives[0].index_count = 0;
    EXPECT_TRUE(borders_of(face).empty());
    EXPECT_TRUE(neck_of(face).empty());
}

TEST(Pinning, TheRingReachesTheWidthAndNoFarther) {
    const Face face = test::make_face({.side = 31, .targets = 0, .seam = true});
    const std::vector<glm::dvec3> places = rest_places(face, glm::dvec3(0));
    const std::vector<std::uint32_t> border = neck_of(face);
    for (const double width : {0.0, 0.1, 0.35}) {
        const std::vector<PinnedVertex> ring = pin_ring(face, places, border, width);
        std::vector<float> influence(places.size(), 0);
        for (const PinnedVertex& entry : ring) {
            influence[entry.vertex] = entry.influence;
            EXPECT_GT(entry.influence, 0);
            float sum = 0;
            for (const float weight : entry.weight) {
                EXPECT_GE(weight, 0);
                sum += weight;
            }
            EXPECT_NEAR(sum, 1, 1e-6F);
        }
        for (std::uint32_t v = 0; v < places.size(); ++v) {
            double nearest = 1e9;
            for (const std::uint32_t b : border) nearest = std::min(nearest, glm::distance(places[v], places[b]));
            if (nearest == 0) {
                EXPECT_EQ(influence[v], 1);
            } else {
                EXPECT_LT(influence[v], 1);
            }
            if (nearest >= width && nearest > 0) {
                EXPECT_EQ(influence[v], 0);
            }
            if (nearest < 0.6 * width) {
                EXPECT_GT(influence[v], 0) << nearest;
            }
        }
    }
}

TEST(Pinning, APinIsMetToTheBitAndWhatMovesTogetherStaysTogether) {
    const Face face = test::make_face({.side = 31, .targets = 0});
    const std::vector<glm::dvec3> places = rest_places(face, glm::dvec3(0));
    const std::vector<std::uint32_t> border = neck_of(face);
    const std::vector<PinnedVertex> ring = pin_ring(face, places, border, 0.4);
    const glm::vec3 aside(0.1F, -0.2F, 0.05F);
    std::vector<Pin> pins;
    for (const std::uint32_t v : border) pins.push_back({face.positions[v] + aside, v, face.normals[v], 0});
    const auto run = [&] {
        Face moved = face;
        apply_pins(ring, pins, {face.positions, face.normals, moved.positions, moved.normals, moved.tangents});
        return moved;
    };
    Face moved = run();
    for (std::size_t i = 0; i < border.size(); ++i) EXPECT_EQ(moved.positions[border[i]], pins[i].position);
    for (const PinnedVertex& entry : ring) {
        const glm::vec3 went = moved.positions[entry.vertex] - face.positions[entry.vertex];
        EXPECT_LT(glm::length(went - entry.influence * aside), 1e-6F) << "all went one way, and so does the ring";
        EXPECT_EQ(moved.normals[entry.vertex], face.normals[entry.vertex]);
    }
    // A pin that does not act changes no bit where it alone would.
    for (Pin& pin : pins) pin.vertex = no_vertex;
    moved = run();
    EXPECT_EQ(moved.positions, face.positions);
    EXPECT_EQ(moved.normals, face.normals);
    EXPECT_EQ(moved.tangents, face.tangents);
}

}  // namespace
}  // namespace blush
