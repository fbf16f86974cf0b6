#include "rig/blood/skin_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_colour_table.h"

namespace blush {
namespace {

SkinChromophores skin(double melanin, double hemoglobin) {
    SkinChromophores c;
    c.melanin = melanin;
    c.hemoglobin = hemoglobin;
    return c;
}

std::size_t sample_at(double nm) {
    return static_cast<std::size_t>(std::lround((nm - first_wavelength_nm) / wavelength_step_nm));
}

TEST(SkinColour, PerfectReflectorIsWhite) {
    std::array<double, spectral_samples> white{};
    white.fill(1);
    const glm::dvec3 rgb = srgb_linear_from_reflectance(white);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1, 1e-12);
}

TEST(SkinColour, SpectraStandAtTheirWavelengths) {
    EXPECT_EQ(spectra.front().wavelength_nm, first_wavelength_nm);
    EXPECT_EQ(spectra.back().wavelength_nm, last_wavelength_nm);
    // The two peaks of oxyhemoglobin and the one of deoxyhemoglobin between them; the observer's peak; D65's own unit.
    EXPECT_GT(spectra[sample_at(540)].oxyhemoglobin, spectra[sample_at(560)].oxyhemoglobin);
    EXPECT_GT(spectra[sample_at(575)].oxyhemoglobin, spectra[sample_at(560)].oxyhemoglobin);
    EXPECT_GT(spectra[sample_at(555)].deoxyhemoglobin, spectra[sample_at(575)].deoxyhemoglobin);
    EXPECT_EQ(spectra[sample_at(555)].y, 1);
    EXPECT_EQ(spectra[sample_at(560)].d65, 100);
}

// W. M. Star, J. P. A. Marijnissen, M. J. C. van Gemert 1988: the diffuse reflectance of a half space in the diffusion
// approximation, collimated light at normal incidence, isotropic scattering.
double half_space(double albedo, double internal_reflection) {
    const double kappa = (1 + internal_reflection) / (1 - internal_reflection);
    return albedo / (1 + 2 * kappa * (1 - albedo) + (1 + 2 * kappa / 3) * std::sqrt(3 * (1 - albedo)));
}

TEST(SkinColour, TwoEqualLayersAreTheKnownHalfSpace) {
    for (const double albedo : {0.1, 0.5, 2.0 / 3, 0.9, 0.99, 0.9999}) {
        for (const double thickness : {0.0, 0.01, 0.25, 5.0}) {
            const LayerOptics layer{3 * (1 - albedo), 3 * albedo};
            // Without a step of index nothing is reflected inside.
            EXPECT_NEAR(two_layer_reflectance({layer, layer}, thickness, 1.0), half_space(albedo, 0), 1e-4)
                << albedo << " " << thickness;
        }
    }
}

TEST(SkinColour, NothingAbsorbedIsAllReturned) {
    EXPECT_NEAR(two_layer_reflectance({{0, 5}, {0, 3}}), 1, 1e-3);
    EXPECT_NEAR(two_layer_reflectance({{5, 0}, {3, 0}}), 0, 1e-9);
}

TEST(SkinColour, DiffusionAgreesWithPhotons) {
    // From the lightest to the darkest skin. The photons' own standard error is below 0.004.
    for (const SkinChromophores& c : {skin(0, 0.002), skin(0.02, 0.02), skin(0.1, 0.05), skin(0.4, 0.02)}) {
        for (const double nm : {450.0, 540.0, 650.0}) {
            const SkinOptics optics = skin_optics(c, spectra[sample_at(nm)]);
            EXPECT_NEAR(two_layer_reflectance(optics), skin_reflectance_by_photons(optics, 20'000, 1), 0.02)
                << c.melanin << " " << c.hemoglobin << " " << nm;
        }
    }
}

TEST(SkinColour, PhotonsReturnTheSameBits) {
    const SkinOptics optics = skin_optics(skin(0.02, 0.02), spectra[20]);
    EXPECT_EQ(skin_reflectance_by_photons(optics, 500, 3), skin_reflectance_by_photons(optics, 500, 3));
}

TEST(SkinColour, MoreMelaninIsNeverLighter) {
    for (int h = 0; h <= 16; ++h) {
        glm::dvec3 before(2);
        double lightness = 200;
        for (int m = 0; m <= 32; ++m) {
            const double u = m / 32.0, v = h / 16.0;
            const glm::dvec3 rgb =
                skin_colour_linear(skin(u * u * u * largest_melanin, v * v * v * largest_hemoglobin));
            EXPECT_LT(lab_from_srgb_linear(rgb).x, lightness);
            lightness = lab_from_srgb_linear(rgb).x;
            for (glm::length_t c = 0; c < 3; ++c) EXPECT_LE(rgb[c], before[c]);
            before = rgb;
        }
    }
}

double redness(const glm::dvec3& rgb) { return rgb.r / rgb.g; }  // as erythema is measured: red over green

TEST(SkinColour, MoreHemoglobinIsNeverLessRed) {
    // Up to 30 % melanin and 7 % blood, the most that is reported of skin. Beyond, blood has taken all the green that
    // comes back from the dermis, what remains is the epidermis's own, and more blood only takes red.
    for (double melanin = 0; melanin <= 0.3; melanin += 0.02) {
        double before = 0;
        for (double hemoglobin = 0; hemoglobin <= 0.07; hemoglobin += 0.002) {
            const double now = redness(skin_colour_linear(skin(melanin, hemoglobin)));
            EXPECT_GT(now, before) << melanin << " " << hemoglobin;
            before = now;
        }
    }
}

TEST(SkinColour, BloodIsRedderThanNoneAndTakesGreen) {
    // Up to 36 % melanin, any amount of blood looks redder than none.
    for (int m = 0; m <= 12; ++m) {
        const double melanin = m * 0.03;
        const double bloodless = redness(skin_colour_linear(skin(melanin, 0)));
        double green = 2;
        for (int h = 1; h <= 32; ++h) {
            const double v = h / 32.0;
            const glm::dvec3 rgb = skin_colour_linear(skin(melanin, v * v * v * largest_hemoglobin));
            EXPECT_GE(redness(rgb), bloodless) << m << " " << h;
            EXPECT_LT(rgb.g, green);
            green = rgb.g;
        }
    }
}

// Patches 1 and 2 of the ColorChecker, which were made to have the reflectances of dark and light human skin (C.
// McCamy, H. Marcus, J. Davidson, "A Color-Rendition Chart", J. Appl. Photogr. Eng. 2(3), 1976), from 380 to 720 nm in
// steps of 10: the mean of 30 charts at 45/0 degrees (D. Pascale, BabelColor, "The ColorChecker pages").
constexpr std::array<double, 35> dark_patch = {0.055, 0.058, 0.061, 0.062, 0.062, 0.062, 0.062, 0.062, 0.062,
                                               0.062, 0.062, 0.063, 0.065, 0.070, 0.076, 0.079, 0.081, 0.084,
                                               0.091, 0.103, 0.119, 0.134, 0.143, 0.147, 0.151, 0.158, 0.168,
                                               0.179, 0.188, 0.190, 0.186, 0.181, 0.182, 0.187, 0.196};
constexpr std::array<double, 35> light_patch = {0.117, 0.143, 0.175, 0.191, 0.196, 0.199, 0.204, 0.213, 0.228,
                                                0.251, 0.280, 0.309, 0.329, 0.333, 0.315, 0.286, 0.273, 0.276,
                                                0.277, 0.289, 0.339, 0.420, 0.488, 0.525, 0.546, 0.562, 0.578,
                                                0.595, 0.612, 0.625, 0.638, 0.656, 0.678, 0.700, 0.717};

struct Fit {
    SkinChromophores chromophores;
    double rms = 1e9, worst = 0, ciede2000 = 0;
};
/// The skin of the model nearest to a patch, over all wavelengths.
Fit nearest_skin(const std::array<double, 35>& patch) {
    Fit best;
    for (int m = 0; m <= 60; ++m) {
        for (int h = 0; h <= 40; ++h) {
            const double u = m / 60.0, v = h / 60.0;
            const auto reflectance =
                skin_reflectance(skin(u * u * u * largest_melanin, v * v * v * largest_hemoglobin));
            double sum = 0, worst = 0;
            for (std::size_t i = 0; i < patch.size(); ++i) {
                const double off = std::abs(reflectance[2 * i] - patch[i]);
                sum += off * off / static_cast<double>(patch.size());
                worst = std::max(worst, off);
            }
            if (std::sqrt(sum) >= best.rms) continue;
            best = {skin(u * u * u * largest_melanin, v * v * v * largest_hemoglobin), std::sqrt(sum), worst, 0};
        }
    }
    std::array<double, spectral_samples> of_patch{};
    for (std::size_t i = 0; i < spectral_samples; ++i) {
        const std::size_t below = i / 2, above = std::min(below + i % 2, patch.size() - 1);
        of_patch[i] = (patch[below] + patch[above]) / 2;
    }
    best.ciede2000 =
        ciede2000_of_srgb_linear(srgb_linear_from_reflectance(of_patch), skin_colour_linear(best.chromophores));
    return best;
}

TEST(SkinColour, HasTheReflectancesOfTheColorCheckersSkins) {
    for (const auto* patch : {&dark_patch, &light_patch}) {
        const Fit fit = nearest_skin(*patch);
        std::printf("%s skin: melanin %.4f, blood %.4f; off by %.4f RMS, %.4f at most; CIEDE2000 %.1f\n",
                    patch == &dark_patch ? "dark" : "light", fit.chromophores.melanin, fit.chromophores.hemoglobin,
                    fit.rms, fit.worst, fit.ciede2000);
        const bool dark = patch == &dark_patch;
        // Both are paints, not skin: tolerances are just above what was found.
        EXPECT_LT(fit.rms, dark ? 0.022 : 0.07);
        EXPECT_LT(fit.ciede2000, dark ? 7.6 : 5.2);
        EXPECT_GT(fit.chromophores.melanin, dark ? 0.1 : 0.002);
        EXPECT_LT(fit.chromophores.melanin, dark ? 0.43 : 0.063) << "beyond the ranges of Jacques 1998";
        if (!dark) {
            EXPECT_GT(fit.chromophores.hemoglobin, 0.005);
            EXPECT_LT(fit.chromophores.hemoglobin, 0.04);
        }
    }
}

// The W of light skin: minima at hemoglobin's two bands, a hump between; dark skin shows next to none of it.
// (skin_published.cpp compares with people.)
TEST(SkinColour, ShowsTheBandsOfBloodThroughLightSkin) {
    const auto light = skin_reflectance(skin(0.012, 0.012)), dark = skin_reflectance(skin(0.25, 0.012));
    const auto hump = [](const auto& r) { return r[sample_at(560)] / ((r[sample_at(545)] + r[sample_at(575)]) / 2); };
    EXPECT_GT(hump(light), 1.03);
    EXPECT_LT(std::abs(hump(dark) - 1), std::abs(hump(light) - 1));
}

TEST(SkinColourTable, IsTheModelAtItsNodes) {
    const SkinColourTable table(5, 4);
    for (std::uint32_t y = 0; y < 4; ++y) {
        for (std::uint32_t x = 0; x < 5; ++x) {
            const double u = x / 4.0, v = y / 3.0;
            const glm::vec3 model(
                glm::max(skin_colour_linear(skin(u * u * u * largest_melanin, v * v * v * largest_hemoglobin)), 0.0));
            EXPECT_EQ(table.texels()[y * 5 + x], model);
            const glm::vec3 looked_up = table.colour_linear_at({static_cast<float>(u), static_cast<float>(v)});
            for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(looked_up[c], model[c], 1e-6F);
        }
    }
}

/// The largest CIEDE2000 between a table and the model over a grid that misses the nodes.
double largest_error(std::uint32_t nodes) {
    const SkinColourTable table(nodes, nodes);
    double worst = 0;
    for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 12; ++x) {
            const double u = (x + 0.37) / 12, v = (y + 0.61) / 12;
            const SkinChromophores c = skin(u * u * u * largest_melanin, v * v * v * largest_hemoglobin);
            const glm::dvec3 looked_up(
                table.colour_linear(static_cast<float>(c.melanin), static_cast<float>(c.hemoglobin)));
            worst = std::max(worst, ciede2000_of_srgb_linear(looked_up, glm::max(skin_colour_linear(c), 0.0)));
        }
    }
    return worst;
}

TEST(SkinColourTable, ErrorFallsWithItsSize) {
    const double of_8 = largest_error(8), of_16 = largest_error(16), of_32 = largest_error(32),
                 of_64 = largest_error(64);
    RecordProperty("error_8", std::to_string(of_8));
    RecordProperty("error_16", std::to_string(of_16));
    RecordProperty("error_32", std::to_string(of_32));
    RecordProperty("error_64", std::to_string(of_64));
    EXPECT_LT(of_16, of_8 / 2);
    EXPECT_LT(of_32, of_16 / 2);
    EXPECT_LT(of_64, of_32 / 2);
    EXPECT_LT(of_64, 0.05);  // a twentieth of what is just noticed
}

TEST(SkinColourTable, OddCoordinatesAreClamped) {
    const SkinColourTable table(8, 8);
    const float nan = std::nanf(""), infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(table.colour_linear(nan, nan), table.colour_linear(0, 0));
    EXPECT_EQ(table.colour_linear(-1, -infinity), table.colour_linear(0, 0));
    EXPECT_EQ(table.colour_linear(infinity, 9), table.colour_linear(0.5F, 0.32F));
    EXPECT_NEAR(table_fraction(table_coordinate(0.02F, 0.32), 0.32), 0.02F, 1e-7F);
}

}  // namespace
}  // namespace blush
