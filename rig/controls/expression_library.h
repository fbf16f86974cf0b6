#pragma once
/// The library of expressions that every face gets: FACS action units, emotions, compound and physiological states,
/// with their wrinkle and hemoglobin weights. Data; a face's own description can replace any part of it.

#include "rig/controls/rig_description.h"

namespace blush {

/// Names are ARKit's, angles', and those of the library itself. In-betweens and correctives are empty.
const RigDescription& expression_library();

}  // namespace blush
