#pragma once
/// Reflection at the surface of skin: Kelemen and Szirmay-Kalos 2001 with Beckmann's distribution and Schlick's Fresnel
/// term (chappuis-2011, 2.3), and the share of light that it leaves for what is below (2.6).

#include <cstdint>
#include <vector>

namespace blush {

/// Reflectance of skin at normal incidence (d'Eon and Luebke 2007: index of refraction 1.4).
inline constexpr double skin_f0 = 0.028;

/// Schlick 1994. v_dot_h: 0 to 1.
double schlick_fresnel(double v_dot_h, double f0 = skin_f0);

/// Beckmann's distribution of microfacets over the half vector, without 1 / pi: exp(-tan^2 / m^2) / (m^2 cos^4)
/// (chappuis-2011, listing 2.4: the BRDF's own division leaves it out too). n_dot_h 0 to 1, roughness above 0.
double beckmann(double n_dot_h, double roughness);

/// The specular BRDF for unit directions of which the cosines are given; `h_length2` is |l + v|^2 of the unnormalised
/// half vector: D F / h^2 / pi. The division by pi is Beckmann's own (chappuis-2011 prints the distribution with pi in
/// 2.3 and computes it without in listing 2.4, where lights are given in units that hold it).
double skin_specular(double n_dot_h, double v_dot_h, double h_length2, double roughness, double f0 = skin_f0);

/// Directional albedo: the integral of skin_specular times the cosine over all directions (eq. of 2.6), for light that
/// arrives, or a view that leaves, at `n_dot_l`. Midpoint rule with `steps` squared directions.
double skin_specular_albedo(double n_dot_l, double roughness, std::uint32_t steps = 128);

/// Mean of skin_specular_albedo over directions, weighted with their cosine: 2 * integral of albedo(c) c dc.
double skin_specular_albedo_mean(double roughness, std::uint32_t steps = 128);

/// The tables that the shader reads: row y is of the roughness (y + 0.5) / rows, column x of the cosine x / (columns -
/// 1), so that a mirror's direction, where a highlight is at its brightest, is a column and not beyond the last one.
/// Beckmann: 0.5 * (distribution)^0.1 (listing 2.4: a range that interpolates well). Albedo: two values an entry, the
/// directional albedo and its mean.
std::vector<float> beckmann_table(std::uint32_t side);
std::vector<float> specular_albedo_table(std::uint32_t columns, std::uint32_t rows, std::uint32_t steps = 20);

}  // namespace blush
