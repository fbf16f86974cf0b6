#pragma once
/// Diffusion in screen space on plain arrays, in double precision: the CPU twins of shaders/light/scatter.frag, and the
/// exact convolution that all of them approximate.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/light/diffusion_profile.h"
#include "rig/light/separable_kernel.h"
#include "rig/vectors.h"

namespace blush {

/// Light to be diffused, as shading leaves it. The matte says how much of a pixel is skin; light and depth are
/// multiplied with it, so that a pixel without skin is all zero and averages of pixels stay right.
struct SkinImage {
    std::uint32_t width = 0, height = 0;
    std::vector<DVec4> light;      ///< rgb times matte, matte
    std::vector<double> depth_mm;  ///< times matte
    std::vector<double> strength;  ///< factor on how far light goes, 0 to 1, times
                                   ///< matte; empty: 1 everywhere
    DVec4& at(std::uint32_t x, std::uint32_t y) { return light[std::size_t{y} * width + x]; }
};

/// Size of a millimetre on the screen: x and y of `scale` over (depth_mm * perspective + 1 - perspective).
struct ScatterProjection {
    DVec2 scale{1};          ///< pixels a millimetre at a depth of 1 mm (perspective), or anywhere (else)
    double perspective = 0;  ///< 1: perspective, 0: orthographic
    /// Pixels a millimetre at a depth; limited to `most_pixels_a_mm`, so that a camera inside the skin stays finite.
    DVec2 pixels_a_mm(double depth_mm) const;
};
inline constexpr double most_pixels_a_mm = 4096;

/// Two passes of the kernel's taps, across and then down. Taps whose depth differs by `follow_mm` or more count as the
/// centre (jimenez-2012, 6.3; 0: do not look at depth). Result: light (not multiplied with the matte) of each pixel, 0
/// without skin.
std::vector<DVec3> scatter_separable(const SkinImage& image, std::span<const KernelTap> taps,
                                     const ScatterProjection& projection, double follow_mm);

/// Sum of Gaussians (jimenez-2012, chapter 4): seven taps a Gaussian and direction, each on what the narrower one left,
/// blended with the weights of eq. 4.8; the narrowest is the image itself. Gaussians under half a pixel are skipped
/// (4.5). Widths shrink with the depth's gradient (4.1, 4.2).
std::vector<DVec3> scatter_gaussians(const SkinImage& image, std::span<const GaussianTerm> profile,
                                     const ScatterProjection& projection);

/// One pass of thirteen taps: the centre, six at a middle and six at a wide distance, turned from pixel to pixel
/// (jimenez-2012, 4.2, after Hable et al. 2009).
struct JitteredRing {
    double radius_mm = 0;
    DVec3 weight{0};  ///< of the whole ring; a tap has a sixth of it
};
struct JitteredKernel {
    JitteredRing middle, wide;  ///< the centre has the rest
};
JitteredKernel jittered_kernel(std::span<const GaussianTerm> profile);
/// Turn of a pixel's taps, radians below a sixth of a circle.
double jitter_radians(std::uint32_t x, std::uint32_t y);
std::vector<DVec3> scatter_jittered(const SkinImage& image, const JitteredKernel& kernel,
                                    const ScatterProjection& projection, double follow_mm);

/// The convolution itself, in two dimensions: each pixel gathers every other skin pixel by the profile's integral over
/// that pixel's square, as far as `reach_mm`. What lies outside the skin or the image, or behind a step of depth
/// (as in scatter_separable), counts as the centre. every: computes only every so many columns and rows, 0 elsewhere.
std::vector<DVec3> scatter_exact(const SkinImage& image, std::span<const GaussianTerm> profile,
                                 const ScatterProjection& projection, double follow_mm, double reach_mm,
                                 std::uint32_t every = 1);

}  // namespace blush
