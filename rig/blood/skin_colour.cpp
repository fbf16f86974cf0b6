/// Coefficients: C. Donner, H. W. Jensen, "A Spectral BSSRDF for Shading Human Skin", EGSR 2006; C. Donner, T. Weyrich,
/// E. d'Eon, R. Ramamoorthi, S. Rusinkiewicz, "A Layered, Heterogeneous Reflectance Model for Acquiring and Rendering
/// Human Skin", SIGGRAPH Asia 2008; both after S. L. Jacques, "Skin Optics", Oregon Medical Laser Center, 1998.
#include "rig/blood/skin_colour.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

/// Whole blood holds 150 g of hemoglobin a litre, 64,500 g a mole; ln 10 turns base 10 into base e (Prahl 1999).
constexpr double blood_absorption_per_mm =
    2.302585092994046 * 150.0 / 64500.0 / 10.0;  // of extinction in cm^-1/(mol/l)
constexpr double oxygenated_share = 0.75;        // Donner and Jensen 2006, for arterial and venous blood together

double blood_absorption(const SpectralSample& at) {
    return blood_absorption_per_mm *
           (oxygenated_share * at.oxyhemoglobin + (1 - oxygenated_share) * at.deoxyhemoglobin);
}

/// Fresnel's reflection of unpolarised light inside a medium of `index`, met at cosine `cosine` to the normal.
double internal_fresnel(double cosine, double index) {
    const double sine2 = index * index * (1 - cosine * cosine);
    if (sine2 >= 1) return 1;
    const double out = std::sqrt(1 - sine2);
    const double s = (index * cosine - out) / (index * cosine + out),
                 p = (cosine - index * out) / (cosine + index * out);
    return (s * s + p * p) / 2;
}

/// Diffuse internal reflection: 2 * integral of F(c) c dc. Midpoints, 1e-4 exact at the 1,000 steps taken.
double diffuse_internal_reflection(double index) {
    constexpr int steps = 1000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        sum += 2 * internal_fresnel(cosine, index) * cosine / steps;
    }
    return sum;
}

/// (1 - e^-x) / x, 1 at 0.
double mean_decay(double x) { return std::abs(x) < 1e-12 ? 1 : -std::expm1(-x) / x; }

/// 53 random bits to (0, 1]. The generator is splitmix64 (Steele, Lea, Flood 2014).
double uniform(std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 1) * 0x1p-53;
}

}  // namespace

SkinOptics skin_optics(const SkinChromophores& c, const SpectralSample& at) {
    const double nm = at.wavelength_nm;
    // Donner and Jensen 2006, section 4: absorption of the two melanins, of bloodless tissue, and of blood, mm^-1.
    const double eumelanin = 6.6e10 * std::pow(nm, -3.33), pheomelanin = 2.9e14 * std::pow(nm, -4.75);
    const double melanin = c.eumelanin_share * eumelanin + (1 - c.eumelanin_share) * pheomelanin;
    const double baseline = 0.0244 + 8.53 * std::exp(-(nm - 154) / 66.2);
    const double blood = blood_absorption(at);
    const double epidermal = c.epidermal_share * c.hemoglobin;

    SkinOptics optics;
    optics.epidermis.absorption_per_mm =
        c.melanin * melanin + epidermal * blood + std::max(0.0, 1 - c.melanin - epidermal) * baseline;
    optics.dermis.absorption_per_mm = c.hemoglobin * blood + (1 - c.hemoglobin) * baseline;
    // Donner and Jensen 2006: Mie and Rayleigh parts; the dermis scatters half as much as the epidermis.
    optics.epidermis.reduced_scattering_per_mm = 14.74 * std::pow(nm, -0.22) + 2.2e11 * std::pow(nm, -4);
    optics.dermis.reduced_scattering_per_mm = 0.5 * optics.epidermis.reduced_scattering_per_mm;
    return optics;
}

// Light that first scatters at depth z leaves the skin with the probability E(z). In the diffusion approximation
// D E'' = a E in each layer, E and D E' run on over their border, and E - z_b E' = 1 at the surface, where z_b = 2 A D
// carries the internal reflection. So E = alpha e^-kz + beta e^-k(d-z) above the border and decays as e^-kz below it,
// and the reflectance is the integral of E over where the collimated beam first scatters.
double two_layer_reflectance(const SkinOptics& optics, double thickness_mm, double refractive_index) {
    // Without any absorption E is 1 everywhere, but k = 0 divides below; no tissue is that clear.
    static constexpr double least_absorption_per_mm = 1e-9;
    struct Layer {
        double extinction, scattering, diffusion, decay;
    };
    const auto layer = [](const LayerOptics& of) {
        const double absorption = std::max(of.absorption_per_mm, least_absorption_per_mm);
        const double extinction = absorption + of.reduced_scattering_per_mm;
        const double diffusion = 1 / (3 * extinction);
        return Layer{extinction, of.reduced_scattering_per_mm, diffusion, std::sqrt(absorption / diffusion)};
    };
    const Layer upper = layer(optics.epidermis), lower = layer(optics.dermis);
    static const double skin_reflection = diffuse_internal_reflection(skin_refractive_index);
    const double reflection =
        refractive_index == skin_refractive_index ? skin_reflection : diffuse_internal_reflection(refractive_index);
    const double boundary_mm = 2 * upper.diffusion * (1 + reflection) / (1 - reflection);

    const double d = thickness_mm, through = std::exp(-upper.decay * d);
    const double q = lower.diffusion * lower.decay / (upper.diffusion * upper.decay);
    const double turned_back = (1 - q) / (1 + q);  // at the border: beta / (alpha e^-kd)
    const double alpha =
        1 / ((1 + boundary_mm * upper.decay) + turned_back * through * through * (1 - boundary_mm * upper.decay));
    const double beta = alpha * through * turned_back;
    const double at_border = alpha * through + beta;

    const double falling = d * mean_decay((upper.extinction + upper.decay) * d);
    const double rising = through * d * mean_decay((upper.extinction - upper.decay) * d);
    const double beam_at_border = std::exp(-upper.extinction * d);
    return upper.scattering * (alpha * falling + beta * rising) +
           lower.scattering * beam_at_border * at_border / (lower.extinction + lower.decay);
}

double skin_reflectance_by_photons(const SkinOptics& optics, std::uint32_t photons, std::uint64_t seed,
                                   double thickness_mm, double refractive_index) {
    // A photon whose weight falls below this lives on with one chance in ten, ten times as heavy (Russian roulette).
    constexpr double light_weight = 1e-3, survivors = 0.1;
    std::uint64_t state = seed;
    double escaped = 0;
    for (std::uint32_t p = 0; p < photons; ++p) {
        double z = 0, cosine = 1, weight = 1;  // cosine > 0: downwards
        while (weight > 0) {
            double optical_path = -std::log(uniform(state));
            // Through as many layers and reflections as the free path lasts.
            for (;;) {
                const bool above = z < thickness_mm || (z == thickness_mm && cosine < 0);
                const LayerOptics& here = above ? optics.epidermis : optics.dermis;
                const double extinction = here.absorption_per_mm + here.reduced_scattering_per_mm;
                const double end = above && cosine < 0 ? 0.0 : thickness_mm;
                const bool ends = above ? cosine != 0 : cosine < 0;
                const double to_end = ends ? (end - z) / cosine * extinction : optical_path + 1;
                if (to_end > optical_path) {
                    z += cosine * optical_path / extinction;
                    weight *= here.reduced_scattering_per_mm / extinction;
                    break;
                }
                optical_path -= to_end;
                z = end;
                if (z == 0 && cosine < 0) {
                    const double reflected = internal_fresnel(-cosine, refractive_index);
                    escaped += weight * (1 - reflected);
                    weight *= reflected;
                    cosine = -cosine;
                    if (weight == 0) break;
                }
            }
            cosine = 2 * uniform(state) - 1;
            if (weight < light_weight) weight = uniform(state) <= survivors ? weight / survivors : 0;
        }
    }
    return escaped / std::max<std::uint32_t>(photons, 1);
}

std::array<double, spectral_samples> skin_reflectance(const SkinChromophores& chromophores) {
    std::array<double, spectral_samples> reflectance{};
    for (std::size_t i = 0; i < spectral_samples; ++i) {
        reflectance[i] = two_layer_reflectance(skin_optics(chromophores, spectra[i]));
    }
    return reflectance;
}

glm::dvec3 skin_colour_linear(const SkinChromophores& chromophores) {
    return srgb_linear_from_reflectance(skin_reflectance(chromophores));
}

}  // namespace blush
