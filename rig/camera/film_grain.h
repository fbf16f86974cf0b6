#pragma once
/// Film grain: the twin of shaders/camera/film_grain.frag.

#include <cstdint>

namespace blush {

/// Noise of mean 0 and variance 1 over all seeds, within +-film_grain_reach(size_pixels): random values on a lattice of
/// `size_pixels` (1 or more), bilinear between. The same for the same arguments.
double film_grain_noise(std::uint32_t x, std::uint32_t y, std::uint32_t frame, std::uint32_t seed, double size_pixels);
double film_grain_reach(double size_pixels);

/// Deviation of a display value of 0 to 1 for a noise of 1. Grains cover a part of the film, the brighter the more, so
/// their number in a pixel is binomial: 2 strength sqrt(value (1 - value)) (after the Boolean model of Newson et al.
/// 2017). Limited so that no value leaves 0 to 1, since what is cut off there would move the mean.
double film_grain_deviation(double display_value, double strength, double size_pixels);

}  // namespace blush
