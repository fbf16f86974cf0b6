#include "rig/blood/skin_colour_table.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace blush {
namespace {

float clamp_to_unit(float x) { return x > 0 ? std::min(x, 1.0F) : 0.0F; }  // NaN is not > 0

}  // namespace

float table_coordinate(float fraction, double largest) {
    return clamp_to_unit(std::cbrt(fraction / static_cast<float>(largest)));
}

float table_fraction(float coordinate, double largest) {
    const float u = clamp_to_unit(coordinate);
    return u * u * u * static_cast<float>(largest);
}

SkinColourTable::SkinColourTable(std::uint32_t melanin_nodes, std::uint32_t hemoglobin_nodes,
                                 const SkinChromophores& kind)
    : melanin_nodes_(melanin_nodes), hemoglobin_nodes_(hemoglobin_nodes) {
    assert(melanin_nodes >= 2 && hemoglobin_nodes >= 2 && "SkinColourTable: an axis has two nodes at least");
    texels_.reserve(std::size_t{melanin_nodes} * hemoglobin_nodes);
    for (std::uint32_t y = 0; y < hemoglobin_nodes; ++y) {
        for (std::uint32_t x = 0; x < melanin_nodes; ++x) {
            const double u = static_cast<double>(x) / (melanin_nodes - 1);
            const double v = static_cast<double>(y) / (hemoglobin_nodes - 1);
            SkinChromophores at = kind;
            at.melanin = u * u * u * largest_melanin;
            at.hemoglobin = v * v * v * largest_hemoglobin;
            texels_.emplace_back(glm::max(skin_colour_linear(at), glm::dvec3(0)));
        }
    }
}

glm::vec3 SkinColourTable::colour_linear(float melanin, float hemoglobin) const {
    return colour_linear_at(
        {table_coordinate(melanin, largest_melanin), table_coordinate(hemoglobin, largest_hemoglobin)});
}

glm::vec3 SkinColourTable::colour_linear_at(glm::vec2 uv) const {
    const float x = clamp_to_unit(uv.x) * static_cast<float>(melanin_nodes_ - 1);
    const float y = clamp_to_unit(uv.y) * static_cast<float>(hemoglobin_nodes_ - 1);
    const auto left = std::min(static_cast<std::uint32_t>(x), melanin_nodes_ - 2);
    const auto top = std::min(static_cast<std::uint32_t>(y), hemoglobin_nodes_ - 2);
    const glm::vec3* const node = &texels_[std::size_t{top} * melanin_nodes_ + left];
    const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
    return glm::mix(glm::mix(node[0], node[1], s), glm::mix(node[melanin_nodes_], node[melanin_nodes_ + 1], s), t);
}

}  // namespace blush
