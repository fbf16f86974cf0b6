#pragma once
/// From the colour of skin back to what colours it: the inverse of the lookup table.

#include <vector>

#include "rig/blood/skin_colour_table.h"
#include "rig/vectors.h"

namespace blush {

/// What explains a colour: colour = shading * table(melanin, hemoglobin), up to `chroma_error`.
struct SkinReading {
    float melanin = 0, hemoglobin = 0;  ///< volume fractions
    float shading = 1;                  ///< light on the texel relative to the exposure
    float chroma_error = 0;  ///< distance between the two colours in density (below), shading apart; 0 in the gamut
};

/// Blue is what cameras and JPEG files (which halve its resolution) get least right, and light from the sky tints
/// shadows; so it counts half.
inline constexpr float yellowness_weight = 0.5F;

/// Finds the point of the table nearest to a colour.
///
/// Distances are taken in optical density, -ln of linear sRGB, where light that falls on a texel adds the same number
/// to all three channels (Tsumura et al. 2003). Density is split into its mean (lightness), green less red (redness),
/// and blue less the mean of both (yellowness). Redness counts fully, yellowness by yellowness_weight, lightness by
/// `lightness_weight`: at 1 a shadow is read as pigment, at 0 all lightness is taken for shading and chroma decides.
class SkinInverter {
public:
    /// `white_linear`: the colour that a perfect white has in the picture (exposure and white balance), above 0.
    /// `lightness_weight`: 0 to 1. The table is copied.
    SkinInverter(const SkinColourTable& table, const Vec3& white_linear, float lightness_weight);

    /// Any input; what is not finite counts as black, and black as the darkest colour told apart (density_floor).
    SkinReading read(const Vec3& colour_linear) const;

private:
    Vec3 density_at(Vec2 uv) const;

    std::uint32_t nodes_;
    std::vector<Vec3> densities_;  ///< (lightness, redness, yellowness), nodes_ * nodes_
    Vec3 white_;
    float lightness_weight_;
};

/// Linear reflectances below this count as this: half of the first step of an 8-bit sRGB channel.
inline constexpr float density_floor = 0.5F / 255 / 12.92F;

/// (lightness, redness, yellowness) of a linear colour, in density.
Vec3 skin_density(const Vec3& colour_linear);

}  // namespace blush
