#include "runtime/files/performance/timecode.h"

#include <array>
#include <charconv>
#include <cstddef>

namespace blush {
namespace {

/// A number of plain digits below `limit`; with a decimal fraction only where that is allowed.
std::optional<double> parse_field(std::string_view text, double limit, bool allow_fraction) {
    double value = 0;
    for (const char c : text) {
        if (!(c >= '0' && c <= '9') && !(allow_fraction && c == '.')) return std::nullopt;
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    if (error != std::errc() || end != text.data() + text.size() || value >= limit) return std::nullopt;
    return value;
}

}  // namespace

std::optional<Timecode> parse_timecode(std::string_view text) {
    std::array<std::string_view, 4> fields;
    std::size_t count = 0;
    while (count < fields.size()) {
        const std::size_t colon = text.find(':');
        fields[count++] = text.substr(0, colon);
        if (colon == std::string_view::npos) {
            text = {};
            break;
        }
        text.remove_prefix(colon + 1);
        if (count == fields.size()) return std::nullopt;
    }
    if (count < 3) return std::nullopt;
    const bool counts_frames = count == 4;
    const auto hours = parse_field(fields[0], 24, false);
    const auto minutes = parse_field(fields[1], 60, false);
    const auto seconds = parse_field(fields[2], 60, !counts_frames);
    const auto frames = counts_frames ? parse_field(fields[3], 60, true) : std::optional(0.0);
    if (!hours || !minutes || !seconds || !frames) return std::nullopt;
    return Timecode{
        .whole_seconds = (*hours * 60 + *minutes) * 60 + *seconds, .frames = *frames, .counts_frames = counts_frames};
}

}  // namespace blush
