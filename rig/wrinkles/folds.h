#pragma once
/// Folds of skin as a height field: ridges and valleys that run across the direction in which the skin is pressed
/// together, with a given spacing.
///
/// Grown from scattered seeds by repeated filtering with local Gabor kernels, as ridge patterns of fingerprints are
/// synthesised (Cappelli, Maio, Maltoni 2000: "Synthetic fingerprint-image generation").

#include <cstdint>
#include <span>
#include <vector>

#include "rig/vectors.h"

namespace blush {

/// wave: for each texel of width x height the wave vector of the folds there: its direction is across the folds, its
/// length in cycles a texel (a fold is at least 4 texels wide: longer vectors count as 1/4, and zero as no folds).
/// Returns -1 (bottom of a valley) to 1 (top of a ridge), 0 where there are no folds. The same seed gives the same
/// bits.
std::vector<float> grow_folds(std::span<const Vec2> wave, std::uint32_t width, std::uint32_t height,
                              std::uint32_t seed);

/// White noise: a number from -1 to 1 for each texel.
float noise_at(std::uint32_t texel, std::uint32_t seed);

}  // namespace blush
