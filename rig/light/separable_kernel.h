#pragma once
/// The separable diffusion kernel of jimenez-2012, chapter 6: two one-dimensional passes in place of a convolution in
/// two dimensions.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/light/diffusion_profile.h"
#include "rig/vectors.h"

namespace blush {

/// What an artist sets, or a fit finds (jimenez-2012, 6.2.1).
struct KernelShape {
    /// How far light goes: 1 is the profile in its own millimetres. Above 0.
    /// Eq. 6.1 prints p[x w / (0.001 + f)], which would narrow the kernel as w grows, against the text and figure 6.5
    /// (b); listing 6 multiplies the distance of the samples by the width, and so does this.
    double width = 1;
    DVec3 strength{1};  ///< 0 to 1: share of the light that enters the skin; the rest leaves where it came
    DVec3 falloff{1};   ///< 0 to 1: how far each channel reaches, as a factor on the red profile

    bool operator==(const KernelShape&) const = default;
};

/// Skin: what `blush kernel --fit skin` finds for the six Gaussians, within 12 mm in 40 x 40 cells. Where the narrowest
/// Gaussian counts as scattered light too, nearly all light enters; table 6.1 leaves it to the delta.
KernelShape skin_kernel_shape();

/// Table 6.1 as printed. Its width of 0.014 is in heads (4.2: "a head 1.0 units tall") for samples at -3 to 3
/// millimetres of the profile (listing 6): 0.014 * 240 mm / 3 mm = 1.12.
KernelShape printed_kernel_shape();

/// The one-dimensional profile p(x), in 1/mm: the red channel of the six Gaussians without the narrowest (light that
/// leaves where it entered, which the delta of eq. 6.1 stands for), scaled to an integral of 1.
double base_profile(double x_mm);
/// Its integral from minus infinity to x.
double base_profile_integral(double x_mm);

/// Where samples end: at three times the width, in mm (listing 6: "the kernels range from -3 to 3").
double kernel_range_mm(const KernelShape& shape);

struct KernelTap {
    double offset_mm = 0;
    DVec3 weight{0};
};

/// Eq. 6.1 as `count` taps (odd, 3 or more), offsets ascending, the middle one at 0, more densely near the centre (the
/// square of equal steps). A tap weighs what the kernel has between the middles to its neighbours. The weights of each
/// channel sum to 1.
std::vector<KernelTap> separable_kernel(const KernelShape& shape, std::uint32_t count);

/// The profile's own integral along a line as the one-dimensional kernel: exact for straight edges of light, in place
/// of the fit of 6.2.2 (pre-integrated kernel, Jimenez et al. 2015). Taps as in separable_kernel(), to three standard
/// deviations of the widest Gaussian times `width` (1: the profile's own millimetres).
std::vector<KernelTap> preintegrated_kernel(std::span<const GaussianTerm> profile, double width, std::uint32_t count);

}  // namespace blush
