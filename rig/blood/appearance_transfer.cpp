#include "rig/blood/appearance_transfer.h"

#include <cassert>

namespace blush {
namespace {

/// Mean blood at rest around each texel of a map of `width` x `height`.
ScalarMap mean_at_rest(const AppearanceMaps& maps, std::uint32_t width, std::uint32_t height,
                       const HemoglobinMapOptions& options) {
    const float radius = options.radius * static_cast<float>(maps.hemoglobin.width);
    return resized(local_statistics(maps.hemoglobin, radius, &maps.skin).mean, width, height);
}

}  // namespace

HemoglobinMaps transferred_maps(const HemoglobinMaps& changes, const TransferFace& from, const TransferFace& to,
                                const HemoglobinMapOptions& options) {
    HemoglobinMaps result;
    const std::uint32_t width = to.canonical.coverage.width, height = to.canonical.coverage.height;
    const ScalarMap to_mean = mean_at_rest(to.maps, width, height, options);
    const ScalarMap from_mean =
        mean_at_rest(from.maps, from.canonical.coverage.width, from.canonical.coverage.height, options);
    for (std::size_t e = 0; e < changes.changes.size(); ++e) {
        const HemoglobinChange& change = changes.changes[e];
        assert(change.scale.same_size(from.canonical.coverage) &&
               "transferred_maps: layout and changes differ in size");
        ScalarMap mean = change.scale, deviation = change.scale;
        for (std::size_t i = 0; i < mean.values.size(); ++i) {
            const float at_rest = from_mean.values[i];
            const float changed = change.scale.values[i] * at_rest + change.offset.values[i];
            mean.values[i] = at_rest > 0 ? changed / at_rest - 1 : 0;
            deviation.values[i] = change.scale.values[i] - 1;
        }
        mean = carried(mean, from.canonical, to.canonical);
        deviation = carried(deviation, from.canonical, to.canonical);
        HemoglobinChange on_other{mean, mean};
        for (std::size_t i = 0; i < mean.values.size(); ++i) {
            const HemoglobinTexel texel = transferred({mean.values[i], deviation.values[i]}, to_mean.values[i]);
            on_other.scale.values[i] = texel.scale;
            on_other.offset.values[i] = texel.offset;
        }
        result.names.push_back(changes.names[e]);
        result.changes.push_back(std::move(on_other));
    }
    return result;
}

}  // namespace blush
