/// The baker of wrinkle maps (`blush bake wrinkles`): work that was done before any frame, so that frames do not do it.

#include <array>
#include <cmath>

#include "rig/wrinkles/wrinkle_error.h"
#include "runtime/effects/baker.h"
#include "runtime/effects/effects.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> parts = {"folds", "whole"};
constexpr std::array<Setting, 6> settings = {{
    {.name = "size",
     .meaning = "texels of a side of the wrinkle map",
     .lowest = 16,
     .highest = 4096,
     .default_number = 256},
    {.name = "mask_size",
     .meaning = "texels of a side of the masks",
     .lowest = 4,
     .highest = 4096,
     .default_number = 64},
    {.name = "spacing", .meaning = "from fold to fold, millimetres", .lowest = 0.5, .highest = 50, .default_number = 8},
    {.name = "range",
     .meaning = "derivative that 8 bits end at (1 is 45 degrees, 4 is 76); 0: the steepest fold's",
     .lowest = 0,
     .highest = 100,
     .default_number = 0},
    {.name = "seed",
     .meaning = "another number, other folds",
     .lowest = 0,
     .highest = 4294967295.0,
     .default_number = 1},
    {"layout",
     "folds: maps of the part of the texture layout where skin folds, so that their texels are small there; whole: of "
     "all of it",
     parts},
}};

Variant variant_of(std::string label, std::string work, bool is_default, const WrinkleErrorCase& of) {
    const auto run = [of] { (void)wrinkle_normal_error(of); };
    const auto error = [of] {
        const NormalError found = wrinkle_normal_error(of);
        return Variant::Error{found.mean_degrees, found.worst_degrees};
    };
    return baker_variant(std::move(label), std::move(work), is_default, run, error);
}

std::vector<Study> studies(const Device& /*device*/, const Face& /*face*/, double /*millimetres_a_unit*/, bool quick) {
    constexpr std::uint32_t base_side = 256;  // of the pores: the same for all variants
    constexpr const char* reference = "a displaced patch of skin in double precision (rig/wrinkles/wrinkle_error.h)";
    Study sizes{"baked folds every 8 mm, 45 degrees steep, on 60 mm of skin", reference, "degrees", {}, nullptr};
    for (const std::uint32_t side : {64U, 128U, 256U, 512U}) {
        WrinkleErrorCase of;
        of.steepest_degrees = 45;
        of.map_side = side;
        of.base_side = base_side;
        sizes.variants.push_back(variant_of("wrinkle_baking.size=" + std::to_string(side),
                                            std::to_string(side) + " texels a side, 8 bits", side == 256, of));
    }
    WrinkleErrorCase exact;
    exact.steepest_degrees = 45;
    exact.eight_bits = false;
    exact.base_side = base_side;
    sizes.variants.push_back(variant_of("256 texels in single precision", "256 texels a side, floats", false, exact));

    if (quick) return {std::move(sizes)};
    // A range of 1 cuts folds of 50 degrees off; wider ones cost precision where the skin is nearly flat.
    Study ranges{"baked folds of 50 degrees", reference, "degrees", {}, nullptr};
    WrinkleErrorCase steep;
    steep.steepest_degrees = 50;
    steep.base_side = base_side;
    const double chosen = std::tan(50 * std::acos(-1.0) / 180);
    for (const double range : {1.0, chosen, 2.0, 4.0}) {
        steep.range = static_cast<float>(range);
        const bool is_chosen = range == chosen;
        ranges.variants.push_back(variant_of(is_chosen
                                                 ? "wrinkle_baking.range=0 (chosen: 1.19)"
                                                 : "wrinkle_baking.range=" + std::to_string(static_cast<int>(range)),
                                             "8 bits", is_chosen, steep));
    }
    return {std::move(sizes), std::move(ranges)};
}

constexpr std::array<HardCase, 2> hard_cases = {{
    {"texture coordinates without an area", "no folds, and finite",
     [](Face& face) { std::ranges::fill(face.uv0, glm::vec2(0.5F)); }},
    {"targets that press everything into one point", "draws nothing, and finite",
     [](Face& face) {
         for (Target& target : face.targets) {
             for (std::size_t i = 0; i < target.vertices.size(); ++i)
                 target.position_deltas[i] = -face.positions[target.vertices[i]];
         }
     }},
}};

}  // namespace

const Effect wrinkle_baking_effect = {
    .name = "wrinkle_baking",
    .what = "finds ahead of time where and how the skin folds",
    .settings = settings,
    .stage = Stage::surface,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
