#pragma once
/// Automatic exposure in double precision: the twin of shaders/exposure_*.frag.

#include "rig/map.h"
#include "rig/vectors.h"

namespace blush {

enum class Metering : std::uint8_t {
    frame,   ///< every pixel alike
    centre,  ///< a bell around the middle, a fifth of the height wide
};

/// Log2 of the log-average luminance of `radiance_linear` (Reinhard et al. 2002, eq. 1; jimenez-2012, 8.3, has the same
/// measure). Pixels that are not finite do not count; what is below 0 counts as 0. Black is 1e-4.
double log2_average_luminance(const Map<DVec3>& radiance_linear, Metering metering);

/// Log2 of the factor that brings the average to `key`, `stops` brighter, within +-`range_stops`.
double log2_exposure(double log2_average, double key, double stops, double range_stops);

/// One step of adaptation in stops: half of the way is done in a half-life, whatever the number of steps.
double adapted(double log2_before, double log2_target, double seconds, double half_life_seconds);

}  // namespace blush
