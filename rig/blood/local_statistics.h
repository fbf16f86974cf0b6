#pragma once
/// Mean and standard deviation of a map around every texel (jimenez-2012, 7.4.1, equation 7.1).

#include "rig/map.h"

namespace blush {

struct LocalStatistics {
    ScalarMap mean, deviation;
};

/// Over the disc of texels whose centres are at most `radius_texels` away. At the map's edge, the part of the disc
/// inside counts. A radius of 0 gives the map itself and deviations of 0; one wider than the map its statistics as a
/// whole. NaN and negative radii count as 0.
///
/// `weights`: of each texel, 0 or more, of the map's size, or nothing for 1 everywhere. Texels that are not finite have
/// no weight. Where a disc has none at all, the mean is that of the whole map (0 when it has none either) and the
/// deviation 0.
///
/// Running sums along rows, so that the cost grows with the radius and not with its square; sums in double precision,
/// about the first value of the map, so that a constant map has deviations of exactly 0.
LocalStatistics local_statistics(const ScalarMap& map, float radius_texels, const ScalarMap* weights = nullptr);

/// The same term by term: the slow twin.
LocalStatistics local_statistics_by_definition(const ScalarMap& map, float radius_texels,
                                               const ScalarMap* weights = nullptr);

/// Half the width of the disc at `row` rows from its centre, texels; -1 outside. Both of the above and the exact
/// histogram matching take their discs from here.
int disc_half_width(float radius_texels, int row);

}  // namespace blush
