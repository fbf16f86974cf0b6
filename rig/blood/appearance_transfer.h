#pragma once
/// Appearance transfer (jimenez-2012, 7.4.2): what an expression does to the blood of one face, done to another's.

#include "rig/blood/hemoglobin_pattern.h"

namespace blush {

/// A face as far as transfer needs it.
struct TransferFace {
    const AppearanceMaps& maps;     ///< at rest
    const CanonicalMap& canonical;  ///< of its texture layout, of the size of the changes
};

/// The relative changes of `changes`, measured against the blood that `from` has at rest around each texel, carried
/// over the mean face, and laid on the blood of `to`. Between faces with one layout and the same blood, the changes
/// come back, smoothed over 2 mm. The result has the size of to.canonical.
HemoglobinMaps transferred_maps(const HemoglobinMaps& changes, const TransferFace& from, const TransferFace& to,
                                const HemoglobinMapOptions& options = {});

}  // namespace blush
