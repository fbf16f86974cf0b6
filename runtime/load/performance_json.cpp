#include "runtime/load/performance_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "runtime/load/performance_text.h"
#include "runtime/load/smooth_keys.h"

namespace blush {
namespace {

using Json = nlohmann::ordered_json;  // channels stay in the order of the file

/// The format nests four deep; anything much deeper is not a performance.
constexpr int most_depth = 16;
/// Ordered objects look a key up by walking through all of them, so that their number must have an end.
constexpr std::size_t most_keys = 16'384;
/// A parsed key pair takes some twenty times the bytes of its text.
constexpr std::size_t most_bytes = 64U << 20;

/// Thrown by the parser's callback and caught in parse(): nlohmann offers no other way to stop.
struct Refusal {
    std::string reason;
};

/// Refuses depth, size and repeated keys while the text is read.
class Guard {
public:
    bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
        using Event = Json::parse_event_t;
        if (depth > most_depth) throw Refusal{"nested more than " + std::to_string(most_depth) + " deep"};
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::object_end) keys_.pop_back();
        if (event == Event::key) {
            const auto& key = parsed.get_ref<const std::string&>();
            if (!keys_.back().insert(key).second)
                throw Refusal{"the key " + in_quotes(key) + " is there twice in one object"};
            if (keys_.back().size() > most_keys) {
                throw Refusal{"an object has more than " + std::to_string(most_keys) + " keys"};
            }
        }
        return true;
    }

private:
    std::vector<std::set<std::string>> keys_;
};

std::string line_and_column(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const std::size_t line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

/// The library's own words for what it found, without its error code and place.
std::string syntax_reason(std::string_view what) {
    for (const std::string_view mark : {"] ", "column ", ": ", " - "}) {
        const std::size_t found = what.find(mark);
        if (found != std::string_view::npos) what.remove_prefix(found + mark.size());
    }
    std::string reason;
    for (const char c : what) reason += (c >= ' ' && c <= '~') ? c : '?';
    return reason;
}

Result<Json> parse(std::string_view text, const std::string& file) {
    try {
        return Json::parse(text.begin(), text.end(), Guard());
    } catch (const Refusal& refusal) {
        return Error{file + ": " + refusal.reason};
    } catch (const Json::parse_error& error) {
        const std::size_t offset = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        return Error{file + ": " + line_and_column(text, offset) + ": not valid JSON: " + syntax_reason(error.what())};
    } catch (const Json::exception& error) {
        // What is left is a number beyond a double's range, quoted in the library's words but without its place.
        std::string_view what = error.what();
        const std::size_t open = what.find('\''), close = what.rfind('\'');
        const std::string_view number =
            open < close ? what.substr(open + 1, close - open - 1) : std::string_view("a number");
        const std::size_t offset = text.find(number);
        return Error{file + ": " + line_and_column(text, offset == std::string_view::npos ? 0 : offset) + ": " +
                     in_quotes(number) + " is out of range"};
    }
}

/// One file on its way to a Performance; collects notes.
class Reader {
public:
    explicit Reader(std::string file) : file_(std::move(file)) {}

    Result<Performance> read(const Json& root) {
        const auto version = root.find("blush_performance");
        if (version == root.end()) return error("the key 'blush_performance' is missing at the top level");
        if (!version->is_number_integer()) return wrong_type("blush_performance", "a whole number", *version);
        if (*version != 1) {
            return error("blush_performance: version " + version->dump() + " is not known, only 1 is");
        }
        if (const auto name = root.find("name"); name != root.end()) {
            if (!name->is_string()) return wrong_type("name", "a string", *name);
            performance_.name = name->get<std::string>();
        }
        const auto channels = root.find("channels");
        if (channels == root.end()) return error("the key 'channels' is missing at the top level");
        if (!channels->is_object()) return wrong_type("channels", "an object", *channels);
        for (const auto& [name, channel] : channels->items()) {
            Result<Track> track = read_channel(channel, "channels." + shown(name));
            if (!track) return track.error();
            performance_.duration_seconds = std::max(performance_.duration_seconds, track->times_seconds.back());
            performance_.channels.push_back({.name = name, .track = *std::move(track)});
        }
        note_unknown_keys(root, "", {"blush_performance", "name", "channels"});
        return std::move(performance_);
    }

private:
    enum class Shape : std::uint8_t { smooth, linear, step, cubic };

    Error error(const std::string& reason) const { return Error{file_ + ": " + reason}; }

    Error wrong_type(const std::string& path, const std::string& wanted, const Json& found) const {
        return error(path + " must be " + wanted + ", not " + found.type_name());
    }

    /// A key as part of a path in a message.
    static std::string shown(const std::string& key) {
        const std::string with_quotes = in_quotes(key);
        return with_quotes.substr(1, with_quotes.size() - 2);
    }

    void note_unknown_keys(const Json& object, const std::string& path, std::initializer_list<std::string_view> known) {
        for (const auto& [key, value] : object.items()) {
            if (std::find(known.begin(), known.end(), key) != known.end()) continue;
            performance_.notes.push_back((path.empty() ? "" : path + ": ") + "the key " + in_quotes(key) +
                                         " is not known and counts for nothing");
        }
    }

    Result<Shape> read_shape(const Json& channel, const std::string& path) const {
        const auto found = channel.find("interpolation");
        if (found == channel.end()) return Shape::smooth;
        if (!found->is_string()) return wrong_type(path + ".interpolation", "a string", *found);
        constexpr std::array<std::pair<std::string_view, Shape>, 4> shapes = {
            {{"smooth", Shape::smooth}, {"linear", Shape::linear}, {"step", Shape::step}, {"cubic", Shape::cubic}}};
        const auto& name = found->get_ref<const std::string&>();
        for (const auto& [known, shape] : shapes) {
            if (name == known) return shape;
        }
        return error(path + ".interpolation: " + in_quotes(name) + " is none of smooth, linear, step, cubic");
    }

    Result<float> read_number(const Json& value, const std::string& path) const {
        if (!value.is_number()) return wrong_type(path, "a number", value);
        const double number = value.get<double>();
        if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max()))) {
            return error(path + ": " + value.dump() + " is beyond the range of a float");
        }
        return static_cast<float>(number);
    }

    Result<Track> read_channel(const Json& channel, const std::string& path) {
        if (!channel.is_object()) return wrong_type(path, "an object", channel);
        const Result<Shape> shape = read_shape(channel, path);
        if (!shape) return shape.error();
        const auto keys = channel.find("keys");
        if (keys == channel.end()) return error(path + ": the key 'keys' is missing");
        if (!keys->is_array()) return wrong_type(path + ".keys", "an array", *keys);
        if (keys->empty()) return error(path + ".keys is empty; a channel needs at least one key");
        note_unknown_keys(channel, path, {"interpolation", "keys"});

        Track track;
        track.interpolation = *shape == Shape::step    ? Interpolation::step
                              : *shape == Shape::cubic ? Interpolation::cubic_spline
                                                       : Interpolation::linear;
        for (std::size_t i = 0; i < keys->size(); ++i) {
            const Status added = add_key((*keys)[i], path + ".keys[" + std::to_string(i) + "]", track);
            if (!added) return added.error();
        }
        return *shape == Shape::smooth ? smooth_track(track) : track;
    }

    Status add_key(const Json& key, const std::string& path, Track& track) const {
        const bool cubic = track.interpolation == Interpolation::cubic_spline;
        const std::size_t wanted = cubic ? 4 : 2;
        if (!key.is_array()) return wrong_type(path, "an array", key);
        if (key.size() != wanted) {
            return error(path + " must have " +
                         (cubic ? "4 numbers (time, value, in-tangent, out-tangent)" : "2 numbers (time, value)") +
                         ", not " + std::to_string(key.size()));
        }
        std::array<float, 4> numbers{};
        for (std::size_t i = 0; i < wanted; ++i) {
            const Result<float> number = read_number(key[i], path + "[" + std::to_string(i) + "]");
            if (!number) return number.error();
            numbers[i] = *number;
        }
        const auto [time, value, in_tangent, out_tangent] = numbers;
        if (time < 0) return error(path + "[0]: the time " + key[0].dump() + " is before 0");
        if (!track.times_seconds.empty() && !(time > track.times_seconds.back())) {
            return error(path + "[0]: the time " + key[0].dump() + " does not come after that of the key before");
        }
        track.times_seconds.push_back(time);
        if (cubic) {
            track.values.insert(track.values.end(), {in_tangent, value, out_tangent});
        } else {
            track.values.push_back(value);
        }
        return Done{};
    }

    std::string file_;
    Performance performance_;
};

}  // namespace

Result<Performance> read_performance_json(std::string_view text, const std::string& file) {
    if (text.size() > most_bytes) {
        return Error{file + ": a JSON performance may have " + std::to_string(most_bytes >> 20) + " MiB, this has " +
                     std::to_string(text.size() >> 20)};
    }
    const Result<Json> root = parse(text, file);
    if (!root) return root.error();
    return Reader(file).read(*root);
}

}  // namespace blush
