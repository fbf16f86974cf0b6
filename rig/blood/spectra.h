#pragma once
/// Published spectra that skin and its colour are computed from, every 5 nm from 380 to 720 nm, and the way from a
/// reflectance spectrum to linear sRGB.

#include <array>
#include <cstddef>

#include "rig/vectors.h"

namespace blush {

/// One wavelength of the tables.
struct SpectralSample {
    double wavelength_nm;
    double oxyhemoglobin, deoxyhemoglobin;  ///< molar extinction coefficient, cm^-1 / (mol/l), base 10
    double x, y, z;                         ///< CIE 1931 colour matching functions (2 degree observer)
    double d65;                             ///< relative power of CIE illuminant D65, 100 at 560 nm
};

inline constexpr std::size_t spectral_samples = 69;
/// The range over which jimenez-2012 (7.6, after Donner et al. 2008) integrates. The colour matching functions outside
/// it hold 0.02 % of Y.
inline constexpr double first_wavelength_nm = 380, last_wavelength_nm = 720, wavelength_step_nm = 5;

extern const std::array<SpectralSample, spectral_samples> spectra;

/// A reflectance, one value for each of `spectra`, under D65 as linear sRGB. A reflectance of 1 everywhere is exactly
/// white, (1, 1, 1) up to rounding. Components can be negative or above 1 where a colour lies outside sRGB's gamut.
DVec3 srgb_linear_from_reflectance(const std::array<double, spectral_samples>& reflectance);

}  // namespace blush
