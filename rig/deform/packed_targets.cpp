#include "rig/deform/packed_targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace blush {
namespace {

/// Runs are made of groups of this many vertices: three vectors of eight floats.
constexpr std::uint32_t group_vertices = 8;
constexpr std::uint32_t block_numbers = 8;
/// A group with fewer moved vertices than this is kept as loose vertices. On the ICT head 2 and 3 take the same time (4
/// and 5 more), and 3 packs fewer bytes.
constexpr std::uint32_t fewest_in_a_group = 3;
/// As many groups that a target leaves alone are filled with zeros to join two rows: starting a row costs about as
/// much.
constexpr std::uint32_t longest_gap = 1;
constexpr float most_steps = 32767;

bool is_minus_zero(float value) { return std::bit_cast<std::uint32_t>(value) == 0x80000000U; }

/// Adding a delta of zero to this changes a bit: -0 + 0 is +0.
template <class Vector>
bool minds_zero(const Vector& rest) {
    return is_minus_zero(rest.x) || is_minus_zero(rest.y) || is_minus_zero(rest.z);
}

/// Packs one attribute: target by target, tile by tile.
template <class Vector>
class Packer {
public:
    Packer(const std::vector<Vector>& rest, DeltaPrecision precision, PackedAttribute& out) : rest_(rest), out_(out) {
        out_.precision = precision;
        out_.components = Vector::length();
        out_.first_piece.push_back(0);
    }

    /// deltas: one for each of `vertices`, or none. `keep(i)` says whether delta i counts.
    template <class Keep>
    void add_target(std::span<const std::uint32_t> vertices, std::span<const glm::vec3> deltas, Keep keep) {
        std::size_t i = 0;
        while (i < deltas.size()) {
            const std::uint32_t tile = vertices[i] / tile_vertices;
            moved_.fill(false);
            bool any = false;
            for (; i < deltas.size() && vertices[i] / tile_vertices == tile; ++i) {
                if (!keep(i)) continue;
                // A delta of zero adds nothing, save to a zero's sign.
                if (deltas[i] == glm::vec3(0) && !minds_zero(rest_[vertices[i]])) continue;
                const std::uint32_t local = vertices[i] % tile_vertices;
                moved_[local] = any = true;
                deltas_[local] = deltas[i];
            }
            if (any) add_piece(tile);
        }
        out_.first_piece.push_back(static_cast<std::uint32_t>(out_.pieces.size()));
    }

private:
    void add_piece(std::uint32_t tile) {
        PackedAttribute::Piece piece;
        piece.tile = tile;
        piece.first_run = out_.runs.size();
        piece.first_loose = out_.loose.size();
        piece.first_block = exact() ? out_.run_floats.size() : out_.run_steps.size();
        piece.step = largest_component() / most_steps;

        choose_rows(std::size_t{tile} * tile_vertices);
        for (std::uint32_t local = 0; local < tile_vertices; ++local) {
            if (!in_row_[local / group_vertices]) {
                if (moved_[local]) out_.loose.push_back(static_cast<std::uint16_t>(local));
                continue;
            }
            if (out_.runs.size() != piece.first_run && out_.runs.back().first + out_.runs.back().count == local) {
                ++out_.runs.back().count;
            } else {
                out_.runs.push_back({static_cast<std::uint16_t>(local), 1});
            }
            const glm::vec3 delta = moved_[local] ? deltas_[local] : glm::vec3(0);
            for (glm::length_t c = 0; c < Vector::length(); ++c) {
                const std::size_t number = count_++;
                if (exact()) {
                    if (number % block_numbers == 0) out_.run_floats.emplace_back();
                    out_.run_floats.back().values[number % block_numbers] = component(delta, c);
                } else {
                    if (number % block_numbers == 0) out_.run_steps.emplace_back();
                    out_.run_steps.back().values[number % block_numbers] = steps(component(delta, c), piece.step);
                }
            }
        }
        for (std::size_t l = piece.first_loose; l < out_.loose.size(); ++l) {
            for (glm::length_t c = 0; c < Vector::length(); ++c) {
                const float value = component(deltas_[out_.loose[l]], c);
                if (exact()) {
                    out_.loose_floats.push_back(value);
                } else {
                    out_.loose_steps.push_back(steps(value, piece.step));
                }
            }
        }
        piece.run_count = static_cast<std::uint32_t>(out_.runs.size() - piece.first_run);
        piece.loose_count = static_cast<std::uint32_t>(out_.loose.size() - piece.first_loose);
        out_.pieces.push_back(piece);
    }

    /// Which groups of the tile that starts at `first_vertex` stand in rows; what moves in the others is loose.
    void choose_rows(std::size_t first_vertex) {
        in_row_.fill(false);
        constexpr std::uint32_t groups = tile_vertices / group_vertices;
        std::uint32_t since_row = longest_gap + 1;  // groups since the last row that could become part of it
        for (std::uint32_t group = 0; group < groups; ++group) {
            std::uint32_t moved = 0;
            bool fits = first_vertex + (group + 1) * std::size_t{group_vertices} <= rest_.size();
            for (std::uint32_t local = group * group_vertices; fits && local < (group + 1) * group_vertices; ++local) {
                moved += moved_[local] ? 1U : 0U;
                if (!moved_[local] && minds_zero(rest_[first_vertex + local])) fits = false;
            }
            if (!fits) {
                since_row = longest_gap + 1;
            } else if (moved >= fewest_in_a_group || (moved > 0 && since_row == 0)) {
                if (since_row <= longest_gap) std::fill_n(in_row_.begin() + (group - since_row), since_row, true);
                in_row_[group] = true;
                since_row = 0;
            } else {
                ++since_row;
            }
        }
    }

    float largest_component() const {
        float largest = 0;
        for (std::uint32_t local = 0; local < tile_vertices; ++local) {
            if (!moved_[local]) continue;
            const glm::vec3 size = glm::abs(deltas_[local]);
            largest = std::max({largest, size.x, size.y, size.z});
        }
        return largest;
    }

    bool exact() const { return out_.precision == DeltaPrecision::exact; }

    /// The fourth component of a tangent is its sign, which no target moves.
    static float component(glm::vec3 delta, glm::length_t c) { return c < 3 ? delta[c] : 0.0F; }

    static std::int16_t steps(float value, float step) {
        // A step of zero: every delta is zero, or so small that the step of the largest one underflows.
        const float count = step > 0 ? std::clamp(value / step, -most_steps, most_steps) : 0.0F;
        return static_cast<std::int16_t>(std::lround(count));
    }

    const std::vector<Vector>& rest_;
    PackedAttribute& out_;
    std::array<bool, tile_vertices> moved_{};
    std::array<glm::vec3, tile_vertices> deltas_{};
    std::array<bool, tile_vertices / group_vertices> in_row_{};
    std::size_t count_ = 0;  ///< numbers in blocks so far; groups fill blocks to the end
};

void build_lists(const PackedAttribute& attribute, std::uint32_t tile_count, std::span<const ActiveTarget> active,
                 std::vector<std::uint32_t>& cursor, ActivePieces::Lists& lists) {
    // A counting sort by tile; going through the targets in ascending order keeps each tile's list ascending.
    lists.first_entry.assign(tile_count + 1, 0);
    const auto each_piece = [&](auto&& visit) {
        for (const ActiveTarget& entry : active) {
            for (std::uint32_t p = attribute.first_piece[entry.target]; p < attribute.first_piece[entry.target + 1];
                 ++p) {
                visit(p, entry.weight);
            }
        }
    };
    each_piece([&](std::uint32_t p, float) { ++lists.first_entry[attribute.pieces[p].tile + 1]; });
    for (std::uint32_t tile = 0; tile < tile_count; ++tile) lists.first_entry[tile + 1] += lists.first_entry[tile];
    cursor.assign(lists.first_entry.begin(), lists.first_entry.end());
    lists.entries.resize(lists.first_entry.back());
    each_piece([&](std::uint32_t p, float weight) { lists.entries[cursor[attribute.pieces[p].tile]++] = {p, weight}; });
}

}  // namespace

std::size_t PackedAttribute::bytes() const {
    const auto size = [](const auto& vector) { return vector.size() * sizeof(vector[0]); };
    return size(first_piece) + size(pieces) + size(runs) + size(loose) + size(run_floats) + size(loose_floats) +
           size(run_steps) + size(loose_steps);
}

PackedTargets::PackedTargets(const Face& face, const PackOptions& options)
    : vertex_count(static_cast<std::uint32_t>(face.positions.size())),
      tile_count(static_cast<std::uint32_t>((face.positions.size() + tile_vertices - 1) / tile_vertices)) {
    assert(options.drop_below >= 0 && "PackedTargets: a threshold of length is 0 or more");
    Packer<glm::vec3> position_packer(face.positions, options.precision, positions);
    Packer<glm::vec3> normal_packer(face.normals, options.precision, normals);
    Packer<glm::vec4> tangent_packer(face.tangents, options.precision, tangents);
    const auto all = [](std::size_t) { return true; };
    for (const Target& target : face.targets) {
        position_packer.add_target(target.vertices, target.position_deltas, [&](std::size_t i) {
            if (options.drop_below == 0) return true;
            const bool keep =
                glm::length(glm::dvec3(target.position_deltas[i])) > static_cast<double>(options.drop_below);
            dropped += keep ? 0U : 1U;
            return keep;
        });
        normal_packer.add_target(target.vertices, target.normal_deltas, all);
        tangent_packer.add_target(target.vertices, target.tangent_deltas, all);
    }
}

void ActivePieces::build(const PackedTargets& packed, std::span<const float> weights) {
    assert(weights.size() + 1 == packed.positions.first_piece.size() &&
           "ActivePieces::build() takes one weight a target");
    find_active(weights, targets);
    build_lists(packed.positions, packed.tile_count, targets, cursor_, positions);
    build_lists(packed.normals, packed.tile_count, targets, cursor_, normals);
    build_lists(packed.tangents, packed.tile_count, targets, cursor_, tangents);
}

}  // namespace blush
