#pragma once
/// Live Link Face recordings (Epic's phone application): one row a pose, ARKit's 52 shapes and nine angles.

#include <string>
#include <string_view>

#include "rig/motion/performance.h"
#include "rig/result.h"

namespace blush {

/// Reads the text of a CSV without byte-order mark. `file` opens every message; rows are lines of the file, from 1.
///
/// Time 0 is the first row, and every step comes from the timecodes: dropped frames stay gaps, with a note. Of rows
/// that repeat a timecode the first is kept, with a note: a stalled recorder has nothing new to say, and any other time
/// for them would be invented. Shape values are kept as recorded, also beyond 0 to 1, with a note. Angles come out in
/// the sense of blush::Angles. Channels carry ARKit's names; a column that is not Live Link's keeps its own.
Result<Performance> read_live_link_csv(std::string_view text, const std::string& file);

}  // namespace blush
