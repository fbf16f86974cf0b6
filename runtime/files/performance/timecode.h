#pragma once
/// Timecodes as Live Link Face writes them.

#include <optional>
#include <string_view>

namespace blush {

/// HH:MM:SS:FF with an optional fraction of a frame ("13:13:04:31.652"), or HH:MM:SS with an optional fraction of a
/// second ("13:13:04.520").
struct Timecode {
    double whole_seconds = 0;    ///< of the day, with the fraction where there is no frame field
    double frames = 0;           ///< 0 to below 60, with its fraction
    bool counts_frames = false;  ///< the frame field is there
};

/// Nothing where `text` is not a timecode: fields missing, not numbers, or out of range (24 h, 60 min, 60 s, 60
/// frames).
std::optional<Timecode> parse_timecode(std::string_view text);

}  // namespace blush
