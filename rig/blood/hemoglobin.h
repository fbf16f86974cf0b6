#pragma once
/// How blood changes with the face (jimenez-2012, 7.4): local histogram matching as a scale and a bias, and the exact
/// matching that they stand for.

#include <span>

#include "rig/blood/local_statistics.h"
#include "rig/map.h"

namespace blush {

/// What one expression does to the hemoglobin at rest: h becomes scale * h + offset.
///
/// The thesis blends scale_i and bias_i over a mean-free map H_0 = H_n - mean_n (7.4 to 7.6). With bias_i = mean_i, and
/// weights that sum to one, the same sum is (sum of w_i scale_i) * H_n + sum of w_i (bias_i - scale_i mean_n), where
/// the neutral terms are 1 and 0. So no mean-free map is stored, and with all weights zero the map at rest comes back
/// bit for bit, however coarse the maps of the expressions are.
struct HemoglobinChange {
    ScalarMap scale;   ///< sigma_i / sigma_n (7.5), 0 or more
    ScalarMap offset;  ///< bias_i - scale_i * mean_n, volume fraction, of either sign
};

/// Scales are limited to this: where the map at rest is nearly flat, sigma_i / sigma_n says nothing.
inline constexpr float largest_hemoglobin_scale = 4;
/// Deviations up to this are flat (0.02 % of blood; one step of an 8-bit map at 2 % blood is 0.05 %): scale 1.
inline constexpr float flat_deviation = 2e-4F;

/// From measured statistics of the face at rest and with the expression, of one size (7.5).
HemoglobinChange hemoglobin_change(const LocalStatistics& neutral, const LocalStatistics& expression);

/// Relative statistics of an expression, free of any face: mean_i / mean_n - 1 and sigma_i / sigma_n - 1.
struct RelativeChange {
    float mean = 0, deviation = 0;
};
/// The same change on a face whose mean at rest is `neutral_mean` (appearance transfer, 7.4.2).
struct HemoglobinTexel {
    float scale = 1, offset = 0;
};
HemoglobinTexel transferred(const RelativeChange& change, float neutral_mean);
/// From statistics to relative ones: what is carried from one face to another. A mean of 0 at rest has change 0.
RelativeChange relative_change(float neutral_mean, float neutral_deviation, float mean, float deviation);

/// Equation 7.6 at one texel. `scales` and `offsets`: those of the expressions there; `weights`: their shares, whose
/// rest up to one is the neutral map's. `factor`: on the hemoglobin of the whole face (7.7). Clamped to 0 to
/// largest_hemoglobin.
float blended_hemoglobin(float neutral, std::span<const float> weights, std::span<const float> scales,
                         std::span<const float> offsets, float factor = 1);

/// Equation 7.6 over a map: the changes may be of any size and are sampled smoothly. `skin`: of the map's size; 0
/// leaves a texel as it is. One weight a change.
ScalarMap blended_hemoglobin(const ScalarMap& neutral, const ScalarMap& skin, std::span<const float> weights,
                             std::span<const HemoglobinChange> changes, float factor = 1);

/// The exact local histogram matching that 7.3 approximates (7.4): every texel goes to the value of `target` that has,
/// within the disc around it, the same percentile as the texel has within the same disc of `source`. Cost: the square
/// of the radius, times its logarithm, a texel. Maps of one size.
ScalarMap matched_locally(const ScalarMap& source, const ScalarMap& target, float radius_texels);

}  // namespace blush
