#pragma once
/// Diffusion profiles: how much of the light that enters at a point leaves at a distance from it.
/// d'Eon, Luebke and Enderton 2007 (sums of Gaussians); jimenez-2012, 4.2.1 and 5.2; Jensen et al. 2001 (dipole).

#include <span>
#include <string_view>
#include <vector>

#include "rig/vectors.h"

namespace blush {

/// One Gaussian G(v, r) = exp(-r^2 / (2 v)) / (2 pi v) of a profile; its integral over the plane is 1.
struct GaussianTerm {
    double variance_mm2 = 0;
    DVec3 weight{0};  ///< red, green, blue
};

/// Three-layer skin by six Gaussians (d'Eon and Luebke 2007; jimenez-2012, table 4.2). The weights of each channel sum
/// to 1 as printed: skin's own colour comes from an albedo. Ascending variance.
std::span<const GaussianTerm> skin_six_gaussians();

/// The same skin by four Gaussians (jimenez-2012, table 4.2; the printed blue sums to 0.9998 and is kept).
std::span<const GaussianTerm> skin_four_gaussians();

/// R(r) in 1/mm^2 (jimenez-2012, eq. 5.3). r_mm: any finite value, taken by its size.
DVec3 profile_at(std::span<const GaussianTerm> profile, double r_mm);

/// Light that reaches a long straight shadow edge's other side: the share of a half plane's light found `x_mm` into the
/// lit side (negative: into the shadow). The closed form that a diffusion of a step has.
DVec3 step_response(std::span<const GaussianTerm> profile, double x_mm);

/// T(s), jimenez-2012, eq. 5.12: what passes a slab `s_mm` thick, of unit irradiance on its back. Eq. 5.10 follows from
/// G(v, r) as exp(-s^2 / (2 v)); the paper prints (and its listing 5.1 computes) exp(-s^2 / v), which lets light
/// through as if the slab were sqrt(2) times as thick. This is the derived one; transmittance_as_printed() the other.
DVec3 transmittance(std::span<const GaussianTerm> profile, double s_mm);
DVec3 transmittance_as_printed(std::span<const GaussianTerm> profile, double s_mm);

/// A homogeneous material, measured (Jensen et al. 2001, figure 5).
struct ScatteringMaterial {
    std::string_view name;
    DVec3 reduced_scattering_per_mm{0}, absorption_per_mm{0};
    double refractive_index = 1.3;
};

/// marble, skin1, skin2, wholemilk, skimmilk, potato, apple, ketchup, cream, chicken1.
std::span<const ScatteringMaterial> measured_materials();

/// A sum of Gaussians that spreads light as the material's dipole does, each channel's weights summing to 1: the colour
/// comes from an albedo. Non-negative least squares on how much light leaves within a distance. Ascending variance.
std::vector<GaussianTerm> gaussians_of(const ScatteringMaterial& material);

/// Most terms of any profile here.
inline constexpr std::size_t most_gaussian_terms = 8;

/// Dipole diffuse reflectance R_d(r), eq. 4 of Jensen et al. 2001, in 1/mm^2, not normalised.
DVec3 dipole_at(const ScatteringMaterial& material, double r_mm);

}  // namespace blush
