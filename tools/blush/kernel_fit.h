#pragma once
/// Fits the separable kernel to a diffusion profile (jimenez-2012, 6.2.2).

#include <functional>
#include <vector>

#include "rig/light/separable_kernel.h"

namespace blush::tool {

/// Where the kernel is held to the profile: points of a quarter plane (both are symmetric), more densely near the
/// centre.
struct FitSamples {
    std::vector<double> distances_mm;     ///< of both coordinates
    std::vector<glm::dvec3> cell_target;  ///< of each pair of them: the profile's share in that cell
};

/// Cells of squares of `steps` steps from 0 to `range_mm`; `profile` in 1/mm^2, scaled to a total of 1 a channel over
/// the square of +-range.
FitSamples fit_samples(const std::function<glm::dvec3(double)>& profile, double range_mm, int steps);

/// Eq. 6.3 with cells in place of points, so that the delta of eq. 6.1 has a meaning: squared differences of the light
/// that falls into each cell, summed over cells, by channel.
glm::dvec3 fit_error(const FitSamples& samples, const KernelShape& shape);

struct KernelFit {
    KernelShape shape;
    glm::dvec3 error{0};  ///< fit_error() there
    int iterations = 0;
    bool converged = false;
};

/// By Ceres' trust region within bounds. Width and falloff change the kernel only by their product, so the width is
/// given and the falloffs are free.
KernelFit fit_kernel(const FitSamples& samples, double width);

/// Shares of the energy (squares of the singular values) that the largest singular values of the profile's matrix hold,
/// by channel (figure 6.2).
std::vector<glm::dvec3> singular_energy(const FitSamples& samples, std::size_t count);

}  // namespace blush::tool
