#pragma once
/// The colour of skin from what colours it: the two-layer spectral model of jimenez-2012, 7.6 (after Donner et al.
/// 2008).
///
/// The thesis gives the parameters and their ranges (table 7.1), C_he = 0.25 C_hd, 61 % eumelanin, and "the total
/// diffuse reflectance predicted by the two-layered translucent skin model"; the coefficients are those that Donner and
/// Jensen 2006 and Donner et al. 2008 publish (skin_colour.cpp names each). Their reflectance is a diffusion solution
/// summed over the plane. Ours is the diffusion solution of the plane itself: an epidermis of finite thickness on a
/// dermis without end, coupled by the fluence and the flux at their border, lit by a collimated beam at normal
/// incidence. skin_reflectance_by_photons() is its exact twin.

#include <array>
#include <cstdint>

#include "rig/blood/spectra.h"
#include "rig/vectors.h"

namespace blush {

/// What colours skin (jimenez-2012, table 7.1). Fractions are of the layer's volume.
struct SkinChromophores {
    double melanin = 0;             ///< C_m, 0 to 0.5: melanosomes in the epidermis
    double hemoglobin = 0;          ///< C_hd, 0 to 0.32: whole blood in the dermis
    double epidermal_share = 0.25;  ///< C_he / C_hd, 0 to 1
    double eumelanin_share = 0.61;  ///< beta_m, 0 to 1: the rest is pheomelanin
};

inline constexpr double largest_melanin = 0.5, largest_hemoglobin = 0.32;

/// Absorption and reduced scattering of one layer, mm^-1.
struct LayerOptics {
    double absorption_per_mm = 0, reduced_scattering_per_mm = 0;
};
struct SkinOptics {
    LayerOptics epidermis, dermis;
};

/// Thickness of the epidermis. Donner and Jensen 2006 take 0.25 mm. With that, the light skin of their own table (1.3 %
/// to 6.3 % melanin) would be as dark as L* 42, and no skin reaches the chroma that is measured on people. The melanin
/// fractions of table 7.1 go back to Jacques 1998, whose epidermis is 0.06 mm; faces have 0.03 to 0.063 mm (Chopra et
/// al. 2015). With 0.06 mm the table spans measured skin (docs/appearance.md).
inline constexpr double epidermis_mm = 0.06;
/// Refractive index of both layers (Donner and Jensen 2006).
inline constexpr double skin_refractive_index = 1.4;

SkinOptics skin_optics(const SkinChromophores& chromophores, const SpectralSample& at);

/// Share of the light that has entered the skin which leaves it again, 0 to 1 (the surface's own reflection is not in
/// it, neither on the way in nor as gloss). `thickness_mm`: of the upper layer, 0 or more.
double two_layer_reflectance(const SkinOptics& optics, double thickness_mm = epidermis_mm,
                             double refractive_index = skin_refractive_index);

/// The exact twin of two_layer_reflectance(): photons followed one by one through the two layers, with Fresnel's
/// reflection at the surface by its angle and isotropic scattering. Its standard error is at most 0.5 / sqrt(photons).
/// The same seed gives the same bits.
double skin_reflectance_by_photons(const SkinOptics& optics, std::uint32_t photons, std::uint64_t seed,
                                   double thickness_mm = epidermis_mm, double refractive_index = skin_refractive_index);

std::array<double, spectral_samples> skin_reflectance(const SkinChromophores& chromophores);

/// Linear sRGB under D65. Very saturated skin leaves sRGB's gamut: a component can be slightly negative.
DVec3 skin_colour_linear(const SkinChromophores& chromophores);

}  // namespace blush
