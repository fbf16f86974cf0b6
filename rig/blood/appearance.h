#pragma once
/// The appearance maps of a face, out of an ordinary colour texture: where it is skin, how much melanin and hemoglobin
/// it holds, and what of its colour these do not explain.

#include <cstdint>
#include <optional>

#include "rig/blood/skin_colour_table.h"
#include "rig/map.h"

namespace blush {

/// All maps are of one size. The colour of a texel is residual * table(melanin, hemoglobin), component by component.
struct AppearanceMaps {
    ScalarMap melanin;     ///< C_m, 0 to largest_melanin
    ScalarMap hemoglobin;  ///< C_hd at rest, 0 to largest_hemoglobin
    ScalarMap skin;        ///< 1 where blood may change the colour, 0 on eyes, hair, seams; between at their edges
    ColourMap residual;    ///< 0 or more: exposure and white balance of the picture, its light, what is not skin
};

/// The 8 bits in which melanin and hemoglobin are stored: their coordinate on the table's axis, so that a texture of
/// them is the coordinate of the lookup. Maps hold no other values, so that a map on disk and one in memory agree; the
/// residual takes up the rounding.
std::uint8_t stored_byte(float fraction, double largest);
float stored_fraction(std::uint8_t byte, double largest);

struct AlbedoOptions {
    /// How much of lightness is read as pigment: 1 all of it (a shadow becomes melanin), 0 none (all is light).
    float lightness_weight = 0.35F;
    /// What the typical skin of the face holds, where that is known; else the point of the table nearest to it.
    std::optional<float> typical_melanin, typical_hemoglobin;
    /// Where the typical skin is looked for: above one half, of any size (face_region()); or nothing for everywhere.
    const ScalarMap* typical_region = nullptr;
};

/// How well the table explains the texture, over its skin.
struct AlbedoReport {
    double skin_share = 0;  ///< of all texels, 0 to 1
    float typical_melanin = 0, typical_hemoglobin = 0;
    Vec3 white_linear{1};         ///< the picture's colour of a perfect white
    float median_difference = 0;  ///< CIEDE2000 between the texture and white * shading * table
    float percentile_99_difference = 0;
    float median_unshaded_difference = 0;  ///< the same between the texture and white * table
};

/// Separates a texture (linear sRGB) into appearance maps. `coverage`: which texels the face uses, above 0, or nothing;
/// of the albedo's size. Texels that are not finite count as black, negative components as 0.
///
/// One picture gives three numbers a texel, and skin has four unknowns (melanin, hemoglobin, light, the camera's
/// white). The white is found once for the face: the typical colour of its skin is taken to be the nearest one that
/// skin of the table can have. Light is separated by AlbedoOptions::lightness_weight. So the maps are relative: where
/// the picture's exposure is unknown, their absolute level is a guess, and shadows with coloured light in them are read
/// as pigment.
AppearanceMaps appearance_from_albedo(const ColourMap& albedo_linear, const SkinColourTable& table,
                                      const AlbedoOptions& options = {}, const ScalarMap* coverage = nullptr,
                                      AlbedoReport* report = nullptr);

/// The colour of every texel of the maps, linear sRGB.
ColourMap recomposed(const AppearanceMaps& maps, const SkinColourTable& table);

}  // namespace blush
