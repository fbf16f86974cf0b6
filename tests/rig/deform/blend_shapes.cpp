// Active targets, their sparse blocks and the lists that the stream-out shader walks.

#include "rig/deform/blend_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <map>
#include <tuple>

#include "tests/test_faces.h"

namespace blush {
namespace {

using test::FaceOptions;
using test::make_face;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(FindActive, ListsWeightsThatAreNotZeroAscending) {
    std::vector<ActiveTarget> active = {{9, 9.0F}};
    const float denormal = std::numeric_limits<float>::denorm_min();
    find_active(std::vector<float>{0, 0.5F, -0.0F, -1, denormal}, active);
    EXPECT_THAT(active, ElementsAre(ActiveTarget{1, 0.5F}, ActiveTarget{3, -1}, ActiveTarget{4, denormal}));
}

TEST(FindActive, CountsWhatIsNotFiniteAsZero) {
    std::vector<ActiveTarget> active;
    const float infinity = std::numeric_limits<float>::infinity();
    find_active(std::vector<float>{std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, 2}, active);
    EXPECT_THAT(active, ElementsAre(ActiveTarget{3, 2}));
    find_active({}, active);
    EXPECT_THAT(active, IsEmpty());
}

TEST(AddTargets, AddsEachDeltaTimesItsWeightAndNothingElse) {
    Face face = make_face({.targets = 0});
    Target target;
    target.vertices = {2, 5};
    target.position_deltas = {{1, 2, 3}, {-1, 0, 4}};
    target.normal_deltas = {{0, 1, 0}, {0, 0, 2}};
    target.tangent_deltas = {{1, 0, 0}, {0, 1, 0}};
    face.targets = {target, target};
    face.targets[1].normal_deltas.clear();
    face.targets[1].tangent_deltas.clear();

    const std::size_t count = face.positions.size();
    std::vector<glm::vec3> positions(count, glm::vec3(1)), normals(count, glm::vec3(0));
    std::vector<glm::vec4> tangents(count, glm::vec4(0, 0, 0, -1));
    add_targets(face, std::vector<ActiveTarget>{{0, 0.5F}, {1, 2.0F}}, positions, normals, tangents);
    EXPECT_EQ(positions[2], glm::vec3(3.5F, 6, 8.5F));
    EXPECT_EQ(positions[5], glm::vec3(-1.5F, 1, 11));
    EXPECT_EQ(normals[2], glm::vec3(0, 0.5F, 0));
    EXPECT_EQ(normals[5], glm::vec3(0, 0, 1));
    EXPECT_EQ(tangents[2], glm::vec4(0.5F, 0, 0, -1));
    EXPECT_EQ(tangents[5], glm::vec4(0, 0.5F, 0, -1));
    for (std::size_t v = 0; v < count; ++v) {
        if (v == 2 || v == 5) continue;
        EXPECT_EQ(positions[v], glm::vec3(1));
        EXPECT_EQ(normals[v], glm::vec3(0));
    }
}

/// All (target, vertex, number of the delta) that a target table gives.
using DeltaPlaces = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;

DeltaPlaces expected_places(const Face& face) {
    DeltaPlaces places;
    std::uint32_t delta = 0;
    for (std::uint32_t t = 0; t < face.targets.size(); ++t) {
        for (const std::uint32_t vertex : face.targets[t].vertices) places[{t, vertex}] = delta++;
    }
    return places;
}

TEST(SparseBlocks, FindEveryDeltaOnce) {
    Face face = make_face({.side = 13, .targets = 9, .seed = 3});  // 169 vertices: the last block is not full
    face.targets.insert(face.targets.begin() + 4, Target{});       // a target that moves nothing
    const SparseBlocks sparse(face);
    ASSERT_EQ(sparse.first_block.size(), face.targets.size() + 1);
    EXPECT_EQ(sparse.block_count, 6U);

    DeltaPlaces found;
    for (std::uint32_t t = 0; t < face.targets.size(); ++t) {
        for (std::uint32_t b = sparse.first_block[t]; b < sparse.first_block[t + 1]; ++b) {
            const SparseBlock& block = sparse.blocks[b];
            EXPECT_NE(block.mask, 0U);
            if (b > sparse.first_block[t]) {
                EXPECT_GT(block.block, sparse.blocks[b - 1].block);
            }
            for (std::uint32_t lane = 0; lane < block_vertices; ++lane) {
                if ((block.mask >> lane & 1U) == 0) continue;
                const std::uint32_t below = block.mask & ((1U << lane) - 1U);
                const std::uint32_t delta = block.first_delta + static_cast<std::uint32_t>(std::popcount(below));
                EXPECT_TRUE(found.emplace(std::pair(t, block.block * block_vertices + lane), delta).second);
            }
        }
    }
    EXPECT_EQ(found, expected_places(face));
    EXPECT_EQ(sparse.first_delta.back(), found.size());
}

TEST(BlockLists, HoldEveryActiveDeltaOnceAscendingByTarget) {
    const Face face = make_face({.side = 13, .targets = 9, .seed = 5});
    const SparseBlocks sparse(face);
    const std::vector<ActiveTarget> active = {{0, 1}, {2, 0.5F}, {3, -1}, {7, 2}};
    BlockLists lists;
    lists.build(sparse, std::vector<ActiveTarget>{{1, 1.0F}, {8, 1.0F}}, 0, 9);  // what it held before must be gone
    lists.build(sparse, active, 0, 9);
    ASSERT_EQ(lists.first_entry.size(), sparse.block_count + 1);
    ASSERT_EQ(lists.entries.size(), lists.first_entry.back());

    DeltaPlaces found;
    for (std::uint32_t block = 0; block < sparse.block_count; ++block) {
        for (std::uint32_t e = lists.first_entry[block]; e < lists.first_entry[block + 1]; ++e) {
            const BlockEntry& entry = lists.entries[e];
            ASSERT_LT(entry.slot, active.size());
            if (e > lists.first_entry[block]) {
                EXPECT_GT(entry.slot, lists.entries[e - 1].slot);
            }
            for (std::uint32_t lane = 0; lane < block_vertices; ++lane) {
                if ((entry.mask >> lane & 1U) == 0) continue;
                const std::uint32_t below = entry.mask & ((1U << lane) - 1U);
                const auto delta = entry.first_delta + static_cast<std::uint32_t>(std::popcount(below));
                EXPECT_TRUE(
                    found.emplace(std::pair(active[entry.slot].target, block * block_vertices + lane), delta).second);
            }
        }
    }
    DeltaPlaces expected = expected_places(face);
    std::erase_if(expected, [&](const auto& place) {
        return std::ranges::find(active, place.first.first, &ActiveTarget::target) == active.end();
    });
    EXPECT_EQ(found, expected);
}

TEST(BlockLists, HoldOnlyTheTargetsOfThePage) {
    const Face face = make_face({.side = 13, .targets = 9, .seed = 5});
    const SparseBlocks sparse(face);
    const std::vector<ActiveTarget> active = {{0, 1}, {2, 0.5F}, {3, -1}, {7, 2}};
    std::size_t entries = 0;
    for (const auto& [first, last] : {std::pair(0U, 2U), std::pair(2U, 3U), std::pair(3U, 9U)}) {
        BlockLists page;
        page.build(sparse, active, first, last);
        for (const BlockEntry& entry : page.entries) {
            EXPECT_GE(active[entry.slot].target, first);
            EXPECT_LT(active[entry.slot].target, last);
        }
        entries += page.entries.size();
    }
    BlockLists all;
    all.build(sparse, active, 0, 9);
    EXPECT_EQ(entries, all.entries.size());
}

}  // namespace
}  // namespace blush
