#include "rig/deform/blend_shapes.h"

#include <cassert>
#include <cmath>

namespace blush {

void find_active(std::span<const float> weights, std::vector<ActiveTarget>& active) {
    active.clear();
    for (std::uint32_t target = 0; target < weights.size(); ++target) {
        const float weight = weights[target];
        if (weight != 0 && std::isfinite(weight)) active.push_back({target, weight});
    }
}

void add_targets(const Face& face, std::span<const ActiveTarget> active, std::span<glm::vec3> positions,
                 std::span<glm::vec3> normals, std::span<glm::vec4> tangents) {
    for (const ActiveTarget& entry : active) {
        const Target& target = face.targets[entry.target];
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            positions[target.vertices[i]] += entry.weight * target.position_deltas[i];
        }
        for (std::size_t i = 0; i < target.normal_deltas.size(); ++i) {
            normals[target.vertices[i]] += entry.weight * target.normal_deltas[i];
        }
        for (std::size_t i = 0; i < target.tangent_deltas.size(); ++i) {
            tangents[target.vertices[i]] += glm::vec4(entry.weight * target.tangent_deltas[i], 0);
        }
    }
}

SparseBlocks::SparseBlocks(const Face& face)
    : block_count(static_cast<std::uint32_t>((face.positions.size() + block_vertices - 1) / block_vertices)) {
    first_block.reserve(face.targets.size() + 1);
    first_delta.reserve(face.targets.size() + 1);
    std::uint32_t delta = 0;
    for (const Target& target : face.targets) {
        first_block.push_back(static_cast<std::uint32_t>(blocks.size()));
        first_delta.push_back(delta);
        for (const std::uint32_t vertex : target.vertices) {
            const std::uint32_t block = vertex / block_vertices;
            if (blocks.size() == first_block.back() || blocks.back().block != block) {
                blocks.push_back({block, delta, 0});
            }
            blocks.back().mask |= 1U << (vertex % block_vertices);
            ++delta;
        }
    }
    first_block.push_back(static_cast<std::uint32_t>(blocks.size()));
    first_delta.push_back(delta);
}

void BlockLists::build(const SparseBlocks& sparse, std::span<const ActiveTarget> active, std::uint32_t first_target,
                       std::uint32_t last_target) {
    const auto blocks_of = [&](const ActiveTarget& entry) {
        return std::span(sparse.blocks)
            .subspan(sparse.first_block[entry.target],
                     sparse.first_block[entry.target + 1] - sparse.first_block[entry.target]);
    };
    const auto listed = [&](const ActiveTarget& entry) {
        return entry.target >= first_target && entry.target < last_target;
    };

    // A counting sort by run; going through the targets in ascending order keeps each run's list ascending.
    first_entry.assign(sparse.block_count + 1, 0);
    for (const ActiveTarget& entry : active) {
        if (!listed(entry)) continue;
        for (const SparseBlock& block : blocks_of(entry)) ++first_entry[block.block + 1];
    }
    for (std::uint32_t block = 0; block < sparse.block_count; ++block) first_entry[block + 1] += first_entry[block];

    cursor_.assign(first_entry.begin(), first_entry.end());
    entries.resize(first_entry.back());
    for (std::uint32_t slot = 0; slot < active.size(); ++slot) {
        if (!listed(active[slot])) continue;
        for (const SparseBlock& block : blocks_of(active[slot])) {
            entries[cursor_[block.block]++] = {block.first_delta, block.mask, slot};
        }
    }
}

}  // namespace blush
