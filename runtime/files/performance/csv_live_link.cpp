#include "runtime/files/performance/csv_live_link.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "rig/names.h"
#include "runtime/files/performance/performance_text.h"
#include "runtime/files/performance/timecode.h"

namespace blush {
namespace {

/// Live Link Face writes 63 columns; a header far longer than any face rig's would only cost memory.
constexpr std::size_t most_columns = 4096;

/// An angle column, and the factor that turns what is recorded (radians) into the sense of blush::Angles.
///
/// The senses were measured, on a recording of 4,030 poses of a person who moved the eyes to every side, by correlating
/// each eye's angles with the shapes of the same eye:
///     LeftEyeYaw    with EyeLookOutLeft   - EyeLookInLeft    -0.9991
///     RightEyeYaw   with EyeLookOutRight  - EyeLookInRight   +0.9991
///     LeftEyePitch  with EyeLookDownLeft  - EyeLookUpLeft    +0.9962
///     RightEyePitch with EyeLookDownRight - EyeLookUpRight   +0.9960
/// "Out" is to the left for the left eye and to the right for the right one, so a recorded yaw is positive to the
/// face's own right (blush: left, hence -1) and a recorded pitch is positive downwards, as blush has it.
/// No shape shows roll. Yaw turned round with pitch kept means axes mirrored left to right, which turns roll round as
/// well: hence -1. The recording bears it out: roll = 0.987 yaw pitch there (R^2 0.9997), which is what an eye without
/// torsion (pitch after yaw about fixed axes) gives when written as yaw-pitch-roll about axes so mirrored.
/// The head is assumed to follow the eyes: that recording's head angles are all zero.
struct AngleColumn {
    std::string_view name;
    float sign;
};
constexpr std::array<AngleColumn, 9> angle_columns = {{
    {"headYaw", -1},
    {"headPitch", 1},
    {"headRoll", -1},
    {"leftEyeYaw", -1},
    {"leftEyePitch", 1},
    {"leftEyeRoll", -1},
    {"rightEyeYaw", -1},
    {"rightEyePitch", 1},
    {"rightEyeRoll", -1},
}};

/// A column that becomes a channel.
struct Column {
    std::size_t cell = 0;
    std::string title;  ///< as the header spells it, for messages
    bool is_shape = false;
    float sign = 1;
    PerformanceChannel channel;
};

struct Header {
    std::size_t cells = 0;
    std::size_t timecode_cell = 0;
    std::vector<Column> columns;
};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const std::size_t first = text.find_first_not_of(blank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Takes the next line off `text`.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    while (true) {
        const std::size_t comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return;
        line.remove_prefix(comma + 1);
    }
}

std::string row_text(const std::string& file, std::size_t row) { return file + ": row " + std::to_string(row); }

std::string plural(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

Result<Header> read_header(std::string_view line, const std::string& file) {
    Header header;
    if (static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) >= most_columns) {
        return Error{row_text(file, 1) + " has more than " + std::to_string(most_columns) + " columns"};
    }
    std::vector<std::string_view> cells;
    split_cells(line, cells);
    header.cells = cells.size();

    const std::vector<std::string> shapes(arkit_names.begin(), arkit_names.end());
    const NameIndex shape_index(shapes);
    std::vector<std::string> angles;
    angles.reserve(std::size(angle_columns));
    for (const AngleColumn& angle : angle_columns) angles.emplace_back(angle.name);
    const NameIndex angle_index(angles);

    std::vector<std::string> seen;
    bool has_timecode = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i].empty()) continue;  // spreadsheets leave empty columns at the end
        const std::string title(cells[i]), folded = canonical_name(title);
        if (std::find(seen.begin(), seen.end(), folded) != seen.end()) {
            return Error{row_text(file, 1) + ": column " + in_quotes(title) + " is there twice"};
        }
        seen.push_back(folded);
        if (folded == "timecode") {
            has_timecode = true;
            header.timecode_cell = i;
        } else if (folded != "blendshapecount") {
            Column column{
                .cell = i, .title = title, .is_shape = false, .sign = 1, .channel = {.name = title, .track = {}}};
            if (const auto shape = shape_index.find(title)) {
                column.is_shape = true;
                column.channel.name = shapes[*shape];
            } else if (const auto angle = angle_index.find(title)) {
                column.sign = angle_columns[*angle].sign;
                column.channel.name = angles[*angle];
            }
            header.columns.push_back(std::move(column));
        }
    }
    if (!has_timecode) {
        return Error{row_text(file, 1) +
                     " has no column 'Timecode': this is neither a Live Link Face CSV nor a blush performance (JSON)"};
    }
    for (const std::string_view name : arkit_names) {
        if (std::find(seen.begin(), seen.end(), canonical_name(name)) == seen.end()) {
            return Error{row_text(file, 1) + " has no column for the shape '" + std::string(name) + "'"};
        }
    }
    return header;
}

/// The value of a cell, or what is wrong with it.
Result<float> read_value(std::string_view cell) {
    if (cell.empty()) return Error{"the cell is empty"};
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc::invalid_argument || end != cell.data() + cell.size()) {
        return Error{in_quotes(cell) + " is not a number"};
    }
    if (error != std::errc() || !(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        return Error{in_quotes(cell) + " is not a finite number in a float's range"};
    }
    return static_cast<float>(value);
}

struct Row {
    std::size_t line = 0;
    Timecode timecode;
    std::string timecode_text;
};

/// Frames counted in a second of timecode. Live Link counts 30 or 60, and says nowhere which: a frame number of 30 or
/// more tells. (The recording named above counts 0 to 59 although a pose comes only every second frame, so the distance
/// of its rows does not tell.) A recording of 60 that is too short to reach frame 30 reads as one of 30.
double frames_per_second(const std::vector<Row>& rows) {
    const bool beyond = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.timecode.frames >= 30; });
    return beyond ? 60 : 30;
}

/// Seconds from the first row, with the rows that repeat the time before them taken out of `rows`.
struct Clock {
    std::vector<float> times_seconds;
    std::vector<bool> keep;  ///< one a row
    std::vector<std::string> notes;
};

Result<Clock> read_clock(const std::vector<Row>& rows, const std::string& file) {
    constexpr double day_seconds = 24 * 60 * 60;
    const double rate = frames_per_second(rows);
    Clock clock;
    std::vector<std::size_t> kept_rows;
    double start = 0, previous = 0, days = 0;
    std::size_t repeats = 0, first_repeat = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Timecode& timecode = rows[i].timecode;
        double seconds = timecode.whole_seconds + timecode.frames / rate + days;
        if (i == 0) {
            start = previous = seconds;
        } else if (seconds < previous && days == 0 && previous - seconds > day_seconds / 2) {
            days = day_seconds;  // past midnight; once, since no recording is a day long
            seconds += day_seconds;
        }
        if (seconds < previous) {
            return Error{row_text(file, rows[i].line) + ", column 'Timecode': " + rows[i].timecode_text +
                         " is earlier than the row before (" + rows[i - 1].timecode_text + ")"};
        }
        previous = seconds;
        // Compared as the floats that the track keeps, so that its times ascend strictly.
        const float time = static_cast<float>(seconds - start);
        const bool repeated = i > 0 && time <= clock.times_seconds.back();
        clock.keep.push_back(!repeated);
        if (repeated) {
            if (repeats++ == 0) first_repeat = rows[i].line;
            continue;
        }
        clock.times_seconds.push_back(time);
        kept_rows.push_back(i);
    }
    if (repeats > 0) {
        clock.notes.push_back(plural(repeats, "row repeats", "rows repeat") +
                              " the timecode before and counts for nothing (first: row " +
                              std::to_string(first_repeat) + ")");
    }

    // A step of more than one and a half times the usual one (the median) has lost frames.
    std::vector<float> steps;
    for (std::size_t i = 1; i < clock.times_seconds.size(); ++i) {
        steps.push_back(clock.times_seconds[i] - clock.times_seconds[i - 1]);
    }
    if (steps.empty()) return clock;
    std::vector<float> sorted = steps;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const float usual = *middle;
    std::size_t places = 0, first_place = 0;
    double dropped = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!(steps[i] > 1.5F * usual)) continue;
        if (places++ == 0) first_place = i;
        dropped += std::round(static_cast<double>(steps[i]) / static_cast<double>(usual)) - 1;
    }
    if (places > 0) {
        const Row& row = rows[kept_rows[first_place]];
        clock.notes.push_back(plural(static_cast<std::size_t>(dropped), "dropped frame", "dropped frames") + " in " +
                              plural(places, "place", "places") + ", first after row " + std::to_string(row.line) +
                              " (" + row.timecode_text + ")");
    }
    return clock;
}

/// What lies beyond a shape's usual range, for one note.
struct Beyond {
    std::size_t count = 0, row = 0;
    float distance = 0, value = 0;
    std::string title;

    void see(const Column& column, float found, std::size_t line) {
        const float far = std::max(found - 1, -found);
        if (!(far > 0)) return;
        ++count;
        if (far > distance) {
            distance = far;
            value = found;
            row = line;
            title = column.title;
        }
    }
};

}  // namespace

Result<Performance> read_live_link_csv(std::string_view text, const std::string& file) {
    Result<Header> read = read_header(take_line(text), file);
    if (!read) return read.error();
    Header header = *std::move(read);

    std::vector<Row> rows;
    std::vector<std::string_view> cells;
    Beyond beyond;
    for (std::size_t line_number = 2; !text.empty(); ++line_number) {
        const std::string_view line = take_line(text);
        if (line.empty()) continue;
        const auto cell_count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
        if (cell_count > header.cells) {
            return Error{row_text(file, line_number) + " has " + plural(cell_count, "cell", "cells") +
                         ", the header has " + std::to_string(header.cells)};
        }
        split_cells(line, cells);
        const auto timecode =
            header.timecode_cell < cells.size() ? parse_timecode(cells[header.timecode_cell]) : std::nullopt;
        if (!timecode) {
            const bool missing = header.timecode_cell >= cells.size();
            return Error{row_text(file, line_number) + ", column 'Timecode': " +
                         (missing ? "the row ends before it"
                                  : in_quotes(cells[header.timecode_cell]) + " is not HH:MM:SS:FF or HH:MM:SS.mmm")};
        }
        for (Column& column : header.columns) {
            const Result<float> value =
                column.cell < cells.size() ? read_value(cells[column.cell]) : Error{"the row ends before it"};
            if (!value) {
                return Error{row_text(file, line_number) + ", column " + in_quotes(column.title) + ": " +
                             value.error().message};
            }
            if (column.is_shape) beyond.see(column, *value, line_number);
            // 0 - x rather than -x: a zero keeps its sign, so that a still eye is written as 0 and not as -0.
            column.channel.track.values.push_back(column.sign < 0 ? 0.0F - *value : *value);
        }
        rows.push_back({line_number, *timecode, std::string(cells[header.timecode_cell])});
    }
    if (rows.empty()) return Error{file + ": there is no row after the header"};

    Result<Clock> clock = read_clock(rows, file);
    if (!clock) return clock.error();
    Performance performance;
    performance.duration_seconds = clock->times_seconds.back();
    performance.notes = std::move(clock->notes);
    if (beyond.count > 0) {
        std::array<char, 32> number{};
        const auto end = std::to_chars(number.data(), number.data() + number.size(), beyond.value).ptr;
        performance.notes.push_back(plural(beyond.count, "value", "values") +
                                    " beyond 0 to 1, kept as recorded (furthest: " + beyond.title + " " +
                                    std::string(number.data(), end) + " in row " + std::to_string(beyond.row) + ")");
    }
    for (Column& column : header.columns) {
        Track& track = column.channel.track;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (clock->keep[i]) track.values[kept++] = track.values[i];
        }
        track.values.resize(kept);
        track.times_seconds = clock->times_seconds;
        performance.channels.push_back(std::move(column.channel));
    }
    return performance;
}

}  // namespace blush
