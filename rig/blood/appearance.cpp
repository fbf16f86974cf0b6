#include "rig/blood/appearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_inversion.h"

namespace blush {
namespace {

/// What a face's typical skin may hold: melanosomes of 1.3 % to 43 % of the epidermis (Jacques 1998). Blood varies
/// far less between faces than melanin (Xiao et al. 2017: the redness of faces is the same in four ethnic groups): from
/// 1.8 % to 4 % of the dermis the table has the a* of 12 to 16 that faces have.
constexpr float least_typical_melanin = 0.013F, most_typical_melanin = 0.43F;
constexpr float least_typical_hemoglobin = 0.018F, most_typical_hemoglobin = 0.04F;

/// A texel is skin as long as its chroma lies within `sure` of what skin can have, and none beyond `never`: 0.1 of
/// density is 10 % in the ratio of two channels. And as long as it is not much darker or lighter than the typical skin:
/// hair, nostrils, eyes, teeth. The limits were set by eye on photographs and painted skins.
constexpr float sure_chroma_error = 0.1F, never_chroma_error = 0.2F;
constexpr float sure_light = 0.8F, never_light = 1.3F;       // natural logarithm of the ratio
constexpr float sure_pigment = 0.3F, never_pigment = 0.45F;  // melanin over the typical, on the table's axis
/// A texture of which less than this could be skin has no typical skin to take a white from.
constexpr double least_candidate_share = 0.2;

float fall(float sure, float never, float x) {
    const float t = std::clamp((x - sure) / (never - sure), 0.0F, 1.0F);
    return 1 - t * t * (3 - 2 * t);
}

float median_of(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

glm::vec3 median_of(const std::vector<glm::vec3>& points) {
    std::vector<float> values(points.size());
    glm::vec3 median(0);
    for (glm::length_t c = 0; c < 3; ++c) {
        std::ranges::transform(points, values.begin(), [c](const glm::vec3& p) { return p[c]; });
        median[c] = median_of(values);
    }
    return median;
}

glm::vec3 cleaned(const glm::vec3& colour) {
    glm::vec3 clean(0);
    for (glm::length_t c = 0; c < 3; ++c) clean[c] = std::isfinite(colour[c]) ? std::max(colour[c], 0.0F) : 0.0F;
    return clean;
}

/// The inverse of skin_density().
glm::vec3 colour_of_density(const glm::vec3& d) {
    // lightness = (r + g + b) / 3, redness = g - r, yellowness = b - (r + g) / 2
    const float red_green = d.x - d.z / 3, blue = d.x + 2 * d.z / 3;
    return {std::exp(-(red_green - d.y / 2)), std::exp(-(red_green + d.y / 2)), std::exp(-blue)};
}

/// The typical colour of what can be skin: the median density, then twice the median of what lies near it. Nothing
/// where too little can be.
std::optional<glm::vec3> typical_density(const ColourMap& albedo, const ScalarMap* coverage, const ScalarMap* region) {
    // Skin of every kind is redder than yellow-green and yellower than blue under any white light. Texels nearer to
    // grey, to black or to a pure colour are left out.
    constexpr float least_redness = 0.08F, most_redness = 1.6F, least_yellowness = -0.05F, most_yellowness = 1.6F;
    constexpr float blackest = 4.5F;          // density: 1 % reflectance
    constexpr std::size_t samples = 200'000;  // the median of these is exact to a part in a thousand of its spread
    const std::size_t stride = std::max<std::size_t>(1, albedo.values.size() / samples);
    std::vector<glm::vec3> densities;
    std::size_t looked_at = 0;
    for (std::size_t i = 0; i < albedo.values.size(); i += stride) {
        if (coverage && !(coverage->values[i] > 0)) continue;
        const glm::vec2 texel(i % albedo.width, i / albedo.width);
        if (region && !(sample(*region, (texel + 0.5F) / glm::vec2(albedo.width, albedo.height)) > 0.5F)) continue;
        ++looked_at;
        const glm::vec3 d = skin_density(cleaned(albedo.values[i]));
        if (d.y > least_redness && d.y < most_redness && d.z > least_yellowness && d.z < most_yellowness &&
            d.x < blackest) {
            densities.push_back(d);
        }
    }
    if (densities.empty() ||
        static_cast<double>(densities.size()) < least_candidate_share * static_cast<double>(looked_at)) {
        return std::nullopt;
    }
    glm::vec3 middle = median_of(densities);
    for (int pass = 0; pass < 2; ++pass) {
        constexpr float near = 0.5F;  // of density in each direction: 60 % in a ratio
        std::vector<glm::vec3> kept;
        std::ranges::copy_if(densities, std::back_inserter(kept), [&](const glm::vec3& d) {
            return glm::all(glm::lessThan(glm::abs(d - middle), glm::vec3(near)));
        });
        if (!kept.empty()) middle = median_of(kept);
    }
    return middle;
}

/// The skin of the table nearest to a density, within what is typical of a face.
glm::vec2 nearest_typical_skin(const SkinColourTable& table, const glm::vec3& density, const AlbedoOptions& options) {
    constexpr int steps = 64;
    const auto limits = [](std::optional<float> known, float least, float most, double largest) {
        return glm::vec2(table_coordinate(known.value_or(least), largest),
                         table_coordinate(known.value_or(most), largest));
    };
    const glm::vec2 us = limits(options.typical_melanin, least_typical_melanin, most_typical_melanin, largest_melanin);
    const glm::vec2 vs =
        limits(options.typical_hemoglobin, least_typical_hemoglobin, most_typical_hemoglobin, largest_hemoglobin);
    glm::vec2 nearest(0);
    float least = std::numeric_limits<float>::infinity();
    for (int j = 0; j <= steps; ++j) {
        for (int i = 0; i <= steps; ++i) {
            const glm::vec2 uv(glm::mix(us.x, us.y, static_cast<float>(i) / steps),
                               glm::mix(vs.x, vs.y, static_cast<float>(j) / steps));
            const glm::vec3 error = skin_density(table.colour_linear_at(uv)) - density;
            const float cost = glm::dot(error, error);
            if (cost >= least) continue;
            least = cost;
            nearest = uv;
        }
    }
    return nearest;
}

float as_stored(float fraction, double largest) { return stored_fraction(stored_byte(fraction, largest), largest); }

}  // namespace

std::uint8_t stored_byte(float fraction, double largest) {
    return static_cast<std::uint8_t>(std::lround(255 * table_coordinate(fraction, largest)));
}

float stored_fraction(std::uint8_t byte, double largest) { return table_fraction(byte / 255.0F, largest); }

AppearanceMaps appearance_from_albedo(const ColourMap& albedo, const SkinColourTable& table,
                                      const AlbedoOptions& options, const ScalarMap* coverage, AlbedoReport* report) {
    const glm::vec3 nothing_known = skin_density(table.colour_linear(0.02F, 0.02F));
    const glm::vec3 typical = typical_density(albedo, coverage, options.typical_region).value_or(nothing_known);
    const glm::vec2 typical_uv = nearest_typical_skin(table, typical, options);
    const float typical_melanin = table_fraction(typical_uv.x, largest_melanin);
    const float typical_hemoglobin = table_fraction(typical_uv.y, largest_hemoglobin);
    const glm::vec3 white = colour_of_density(typical) / table.colour_linear_at(typical_uv);
    const SkinInverter inverter(table, white, options.lightness_weight);

    AppearanceMaps maps;
    maps.melanin = maps.hemoglobin = maps.skin = ScalarMap(albedo.width, albedo.height);
    maps.residual = ColourMap(albedo.width, albedo.height);
    std::vector<float> differences, unshaded_differences;
    double skin_sum = 0;
    for (std::size_t i = 0; i < albedo.values.size(); ++i) {
        const glm::vec3 colour = cleaned(albedo.values[i]);
        const SkinReading reading = inverter.read(colour);
        float skin =
            fall(sure_chroma_error, never_chroma_error, reading.chroma_error) *
            fall(sure_light, never_light, std::abs(std::log(reading.shading))) *
            fall(sure_pigment, never_pigment, table_coordinate(reading.melanin, largest_melanin) - typical_uv.x);
        if (coverage && !(coverage->values[i] > 0)) skin = 0;
        // What is not skin gets the typical skin under its residual, so that filtering across an edge stays smooth.
        maps.melanin.values[i] = as_stored(glm::mix(typical_melanin, reading.melanin, skin), largest_melanin);
        maps.hemoglobin.values[i] =
            as_stored(glm::mix(typical_hemoglobin, reading.hemoglobin, skin), largest_hemoglobin);
        maps.skin.values[i] = skin;
        const glm::vec3 explained = table.colour_linear(maps.melanin.values[i], maps.hemoglobin.values[i]);
        maps.residual.values[i] = colour / glm::max(explained, glm::vec3(density_floor));
        skin_sum += static_cast<double>(skin);
        if (report && skin > 0.5F) {
            const glm::vec3 shaded = white * reading.shading * explained, unshaded = white * explained;
            differences.push_back(static_cast<float>(ciede2000_of_srgb_linear(colour, shaded)));
            unshaded_differences.push_back(static_cast<float>(ciede2000_of_srgb_linear(colour, unshaded)));
        }
    }
    if (report) {
        *report = {};
        report->skin_share = skin_sum / static_cast<double>(std::max<std::size_t>(albedo.values.size(), 1));
        report->typical_melanin = typical_melanin;
        report->typical_hemoglobin = typical_hemoglobin;
        report->white_linear = white;
        if (!differences.empty()) {
            report->median_difference = median_of(differences);
            report->median_unshaded_difference = median_of(unshaded_differences);
            const auto place = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 99 / 100);
            std::ranges::nth_element(differences, place);
            report->percentile_99_difference = *place;
        }
    }
    return maps;
}

ColourMap recomposed(const AppearanceMaps& maps, const SkinColourTable& table) {
    ColourMap colours(maps.melanin.width, maps.melanin.height);
    for (std::size_t i = 0; i < colours.values.size(); ++i) {
        colours.values[i] =
            maps.residual.values[i] * table.colour_linear(maps.melanin.values[i], maps.hemoglobin.values[i]);
    }
    return colours;
}

}  // namespace blush
