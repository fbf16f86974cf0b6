/// Sizes and ranges of baked wrinkle maps, on a patch of skin whose folds are known.

#include <cmath>
#include <numbers>

#include "rig/wrinkles/wrinkle_error.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

Variant variant_of(std::string label, std::string work, bool is_default, const WrinkleErrorCase& of) {
    const auto run = [of] { (void)wrinkle_normal_error(of); };
    const auto error = [of] {
        const NormalError found = wrinkle_normal_error(of);
        return Variant::Error{found.mean_degrees, found.worst_degrees};
    };
    return {std::move(label), run, error, std::move(work), is_default};
}

}  // namespace

std::vector<Study> studies::wrinkle_baking(const Device& /*device*/, const Face& /*face*/,
                                           double /*millimetres_a_unit*/, bool quick) {
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
    const double chosen = std::tan(50 * std::numbers::pi / 180);
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

}  // namespace blush
