/// The table of skin's colour, blood by scale and bias, and a texture out of its pigments.

#include <algorithm>

#include "rig/blood/appearance.h"
#include "rig/blood/colour_difference.h"
#include "rig/blood/hemoglobin.h"
#include "rig/blood/skin_colour_table.h"
#include "rig/blood/skin_inversion.h"
#include "runtime/files/appearance_file.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

const SkinColourTable& exact_table() {
    // Differs from the model by CIEDE2000 0.002 at most; the model itself takes a millisecond for a hundred colours.
    static const SkinColourTable table(192, 192);
    return table;
}

Variant::Error difference(const ScalarMap& a, const ScalarMap& b, float melanin) {
    Variant::Error error;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        const double d = ciede2000_of_srgb_linear(glm::dvec3(exact_table().colour_linear(melanin, a.values[i])),
                                                  glm::dvec3(exact_table().colour_linear(melanin, b.values[i])));
        error.mean += d / static_cast<double>(a.values.size());
        error.worst = std::max(error.worst, d);
    }
    return error;
}

/// Between the nodes of all of the sizes: the model itself.
Study table_study() {
    Study study{"the table of skin's colour, between its nodes",
                "the spectral model in double precision",
                "CIEDE2000",
                {},
                nullptr};
    for (const std::uint32_t nodes : {8U, 16U, 32U, 64U}) {
        const auto run = [nodes] { const SkinColourTable table(nodes, nodes); };
        const auto error_of = [nodes] {
            const SkinColourTable table(nodes, nodes);
            constexpr int steps = 11;
            Variant::Error error;
            for (int i = 0; i < steps * steps; ++i) {
                SkinChromophores skin;
                skin.melanin = static_cast<double>(
                    table_fraction((static_cast<float>(i % steps) + 0.37F) / steps, largest_melanin));
                skin.hemoglobin = static_cast<double>(
                    table_fraction((static_cast<float>(i / steps) + 0.61F) / steps, largest_hemoglobin));
                const glm::dvec3 looked_up(
                    table.colour_linear(static_cast<float>(skin.melanin), static_cast<float>(skin.hemoglobin)));
                const double d = ciede2000_of_srgb_linear(looked_up, glm::max(skin_colour_linear(skin), glm::dvec3(0)));
                error.mean += d / (steps * steps);
                error.worst = std::max(error.worst, d);
            }
            return error;
        };
        study.variants.push_back({"blood.table_nodes=" + std::to_string(nodes), run, error_of,
                                  std::to_string(nodes * nodes) + " colours", nodes == SkinColourTable::default_nodes});
    }
    return study;
}

/// The face's blood at rest, and the same mirrored and half as much again as its expression: other vessels, more blood.
struct Blood {
    ScalarMap rest, expression, skin, exact;
    float melanin = 0.02F, radius = 4;
};

/// Scale and bias (7.3) at several resolutions against the exact local histogram matching that they stand for.
Study matching_study(const std::shared_ptr<const Blood>& blood) {
    Study study{"scale and bias of an expression with half as much blood again, 64 x 64 texels of the face",
                "exact local histogram matching",
                "CIEDE2000",
                {},
                std::const_pointer_cast<Blood>(blood)};
    const std::uint32_t side = blood->rest.width;
    for (const std::uint32_t coarser : {1U, 2U, 4U, 8U}) {
        const auto matched = [blood, coarser, side] {
            HemoglobinChange change = hemoglobin_change(local_statistics(blood->rest, blood->radius),
                                                        local_statistics(blood->expression, blood->radius));
            change.scale = resized(change.scale, side / coarser, side / coarser);
            change.offset = resized(change.offset, side / coarser, side / coarser);
            const float weight = 1;
            return blended_hemoglobin(blood->rest, blood->skin, std::span(&weight, 1), std::span(&change, 1));
        };
        study.variants.push_back({coarser == 1 ? "at full resolution" : "at 1/" + std::to_string(coarser) + " of it",
                                  [matched] { (void)matched(); },
                                  [matched, blood] { return difference(matched(), blood->exact, blood->melanin); },
                                  std::to_string(side / coarser) + " texels a side", coarser == 4});
    }
    study.variants.push_back({"exact histogram matching",
                              [blood] { (void)matched_locally(blood->rest, blood->expression, blood->radius); },
                              [] { return Variant::Error{}; }, std::to_string(side) + " texels a side"});
    study.variants.push_back({"no change at all", [] {},
                              [blood] { return difference(blood->rest, blood->exact, blood->melanin); }, "nothing"});
    return study;
}

/// What white * light * table leaves of the texture's colour unexplained: what the residual holds besides light.
Study inversion_study(const std::shared_ptr<const ColourMap>& albedo) {
    Study study{"colours of the face's texture out of its melanin and blood, 128 texels a side",
                "the texture",
                "CIEDE2000 (median, and 99th percentile as worst)",
                {},
                std::const_pointer_cast<ColourMap>(albedo)};
    constexpr std::array<std::pair<const char*, float>, 3> lightnesses = {{{"0", 0.0F}, {"0.35", 0.35F}, {"1", 1.0F}}};
    for (const auto& [name, lightness] : lightnesses) {
        const auto report = [albedo, lightness = lightness] {
            AlbedoOptions options;
            options.lightness_weight = lightness;
            AlbedoReport found;
            (void)appearance_from_albedo(*albedo, exact_table(), options, nullptr, &found);
            return found;
        };
        const auto error = [report] {
            const AlbedoReport found = report();
            return Variant::Error{static_cast<double>(found.median_difference),
                                  static_cast<double>(found.percentile_99_difference)};
        };
        study.variants.push_back({std::string("appearance_baking.lightness=") + name, [report] { (void)report(); },
                                  error, std::to_string(albedo->values.size()) + " texels inverted",
                                  lightness > 0 && lightness < 1});
    }
    return study;
}

/// The colour texture of the first material that has one and whose name or tag says skin; of the largest one otherwise.
std::shared_ptr<const ColourMap> albedo_of(const Face& face) {
    const Material* chosen = nullptr;
    for (const Material& material : face.materials) {
        if (material.base_color_srgb.image < 0) continue;
        if (chosen == nullptr || material.skin.value_or(false)) chosen = &material;
    }
    if (chosen == nullptr) return nullptr;
    const Result<ColourMap> map =
        colour_map_of(face.images[static_cast<std::size_t>(chosen->base_color_srgb.image)], face.path);
    return map ? std::make_shared<const ColourMap>(resized(*map, 128, 128)) : nullptr;
}

}  // namespace

std::vector<Study> studies::appearance_baking(const Device& /*device*/, const Face& face, double /*millimetres_a_unit*/,
                                              bool quick) {
    std::vector<Study> result;
    result.push_back(table_study());
    const std::shared_ptr<const ColourMap> albedo = albedo_of(face);
    if (!albedo || quick) return result;
    const AppearanceMaps maps = appearance_from_albedo(*albedo, exact_table());
    auto blood = std::make_shared<Blood>();
    constexpr std::uint32_t side = 64;
    blood->rest = blood->expression = ScalarMap(side, side);
    blood->skin = ScalarMap(side, side, 1);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            blood->rest.at(x, y) = maps.hemoglobin.at(32 + x, 32 + y);
            blood->expression.at(x, y) = 1.5F * maps.hemoglobin.at(95 - x, 32 + y);
        }
    }
    blood->exact = matched_locally(blood->rest, blood->expression, blood->radius);
    result.push_back(matching_study(blood));
    result.push_back(inversion_study(albedo));
    return result;
}

}  // namespace blush
