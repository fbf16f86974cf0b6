#pragma once
/// Settings of the filters that smooth one picture: MLAA (jimenez-2012, chapter 9) and SMAA 1x (chapter 10), which the
/// other modes of SMAA run on each of their subsamples.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "rig/vectors.h"

namespace blush {

/// What a discontinuity is looked for in (jimenez-2012, 9.3 and 10.4.1).
enum class EdgeSource : std::uint8_t {
    luma,   ///< of colours as a display shows them: always there, and sees shading too
    color,  ///< the channel that differs most: finds edges between colours of one luma
    depth,  ///< silhouettes alone; needs a depth texture
};

/// What the fourth channel holds.
enum class AlphaMeaning : std::uint8_t {
    carried,        ///< anything: blended as it is, and no edge by itself
    straight,       ///< coverage that the colours are not multiplied by (PNG): blended in proportion to it
    premultiplied,  ///< coverage that the colours are multiplied by (OpenEXR)
};

/// How numbers stand for light.
enum class Transfer : std::uint8_t { srgb, linear };

/// Where depth has an edge too, the threshold is lowered, elsewhere raised, so that shading needs more contrast than a
/// silhouette: threshold * scale * (1 - strength where depth differs by more than depth_threshold). Not in
/// jimenez-2012; the authors' published shader has it under this name.
struct Predication {
    bool on = false;
    float depth_threshold = 0.01F;  ///< window depth, 0 to 1
    float scale = 2;                ///< 1 to 5
    float strength = 0.4F;          ///< 0 to 1

    bool operator==(const Predication&) const = default;
};

struct EdgeSettings {
    EdgeSource source = EdgeSource::luma;
    float threshold = 0.1F;         ///< contrast of luma or colour, 0 to 0.5; lower finds more edges
    float depth_threshold = 0.01F;  ///< difference of window depth, for EdgeSource::depth
    /// An edge is kept only where its contrast is above this share of the greatest beside it (eq. 10.1). 0: off.
    float contrast_factor = 0.5F;
    Predication predication = {};

    bool operator==(const EdgeSettings&) const = default;
};

struct SmaaSettings {
    EdgeSettings edges;
    /// Reach of a search along a line, in steps of two pixels: 1 to 32 (lines of up to 63 pixels to each side).
    int search_steps = 16;
    /// Reach of a search along a diagonal, in pixels: 0 (no diagonals) to 19.
    int diagonal_search_steps = 8;
    /// r of eq. 10.2: how much of its rounding a sharp corner keeps, 0 (none) to 1 (all, as MLAA).
    float corner_rounding = 0.25F;

    bool operator==(const SmaaSettings&) const = default;
};

struct MlaaSettings {
    /// Chapter 9 has no adaptation to local contrast.
    EdgeSettings edges{.contrast_factor = 0};
    /// Steps of two pixels: 1 to 4, since its area table reaches 8 pixels (9.4.3).
    int search_steps = 4;

    bool operator==(const MlaaSettings&) const = default;
};

/// How the picture's numbers are to be read, and whether neighbours are mixed as light.
struct PictureMeaning {
    Transfer transfer = Transfer::srgb;
    AlphaMeaning alpha = AlphaMeaning::carried;
    /// Mix in linear light. Coverage is a share of light, so this is right for every picture that a display shows as it
    /// is; off, an edge of dark on light comes out too dark, as most engines had it when the paper was written.
    bool blend_in_linear_light = true;

    bool operator==(const PictureMeaning&) const = default;
};

inline constexpr int largest_search_steps = 32, largest_diagonal_search_steps = 19, largest_mlaa_search_steps = 4;

enum class SmaaPreset : std::uint8_t { low, medium, high, ultra };
inline constexpr std::array<std::string_view, 4> smaa_preset_names = {"low", "medium", "high", "ultra"};

/// Thresholds and reaches of the authors' published presets.
SmaaSettings smaa_preset(SmaaPreset preset);

/// Slices of the area table (smaa_tables.h), one for each direction of line: x of horizontal lines, y of vertical
/// ones, z of diagonals towards the upper right, w of those towards the lower right.
using SubsampleSlices = IVec4;

/// The slices for a picture whose samples stand `offset_pixels` from the pixel centres (x to the right, y the way rows
/// are counted), each coordinate rounded to the nearest offset in the table. (jimenez-2012, 10.4.3)
SubsampleSlices subsample_slices(Vec2 offset_pixels);

}  // namespace blush
