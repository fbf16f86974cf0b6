#pragma once
/// The lookup table of skin colour (jimenez-2012, 7.6): melanin along u, hemoglobin along v, both by their cube roots
/// (7.7), so that a small table has most of its nodes where colour changes most.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/blood/skin_colour.h"
#include "rig/vectors.h"

namespace blush {

class SkinColourTable {
public:
    /// Computes every node with skin_colour_linear(). Sides: 2 or more nodes; negative components (colours outside
    /// sRGB's gamut) become 0. `kind` gives what the axes do not: the share of epidermal blood, the melanin blend.
    explicit SkinColourTable(std::uint32_t melanin_nodes = default_nodes,
                             std::uint32_t hemoglobin_nodes = default_nodes, const SkinChromophores& kind = {});

    /// docs/appearance.md has the error of each size.
    static constexpr std::uint32_t default_nodes = 64;

    std::uint32_t melanin_nodes() const { return melanin_nodes_; }
    std::uint32_t hemoglobin_nodes() const { return hemoglobin_nodes_; }
    /// Linear sRGB, rows of constant hemoglobin, melanin running fastest: ready for a texture with u to the right.
    std::span<const Vec3> texels() const { return texels_; }

    /// Volume fractions to linear sRGB by bilinear interpolation between the four nodes around. Fractions outside
    /// 0 to largest_melanin and largest_hemoglobin count as the nearest end, NaN as 0.
    Vec3 colour_linear(float melanin, float hemoglobin) const;
    /// The same at table coordinates, 0 at the first node to 1 at the last.
    Vec3 colour_linear_at(Vec2 uv) const;

private:
    std::uint32_t melanin_nodes_, hemoglobin_nodes_;
    std::vector<Vec3> texels_;
};

/// Where a volume fraction stands on its axis, 0 to 1: cbrt(fraction / largest) (7.7). Clamped; NaN counts as 0.
float table_coordinate(float fraction, double largest);
/// The volume fraction at a place on an axis; clamped to 0 to 1 first.
float table_fraction(float coordinate, double largest);

}  // namespace blush
