#include "runtime/files/performance/performance_json.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "runtime/files/json_text.h"
#include "runtime/files/performance/performance_text.h"
#include "runtime/files/performance/smooth_keys.h"

namespace blush {
namespace {

constexpr std::string_view ease_names = "smooth, linear, step, ease-in, ease-out, ease-in-out";

/// A key or a name as part of a path in a message.
std::string shown(const std::string& key) {
    const std::string with_quotes = in_quotes(key);
    return with_quotes.substr(1, with_quotes.size() - 2);
}

std::string member(const std::string& path, std::string_view key) {
    return path + (path.empty() ? "" : ".") + std::string(key);
}

std::string entry(const std::string& path, std::size_t index) { return path + "[" + std::to_string(index) + "]"; }

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
        if (Status read = read_text(root, "", "name", performance_.name); !read) return read.error();
        if (Status read = read_channels(root, "", performance_.channels); !read) return read.error();
        if (Status read = read_loop(root, "", performance_.channels, performance_.loop); !read) return read.error();
        if (Status read = read_layers(root); !read) return read.error();
        if (Status read = read_markers(root); !read) return read.error();
        note_unknown_keys(root, "", {"blush_performance", "name", "channels", "loop", "length", "layers", "markers"});
        find_duration();
        return std::move(performance_);
    }

private:
    Error error(const std::string& reason) const { return Error{file_ + ": " + reason}; }

    Error wrong_type(const std::string& path, const std::string& wanted, const Json& found) const {
        return error(path + " must be " + wanted + ", not " + found.type_name());
    }

    void note_unknown_keys(const Json& object, const std::string& path, std::initializer_list<std::string_view> known) {
        for (const auto& [key, value] : object.items()) {
            if (std::find(known.begin(), known.end(), key) != known.end()) continue;
            performance_.notes.push_back((path.empty() ? "" : path + ": ") + "the key " + in_quotes(key) +
                                         " is not known and counts for nothing");
        }
    }

    /// Leaves `text` as it is where the key is missing.
    Status read_text(const Json& object, const std::string& path, std::string_view key, std::string& text) const {
        const auto found = object.find(key);
        if (found == object.end()) return Done{};
        if (!found->is_string()) return wrong_type(member(path, key), "a string", *found);
        text = found->get<std::string>();
        return Done{};
    }

    Result<float> read_number(const Json& value, const std::string& path) const {
        if (!value.is_number()) return wrong_type(path, "a number", value);
        const double number = value.get<double>();
        if (!(std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max()))) {
            return error(path + ": " + value.dump() + " is beyond the range of a float");
        }
        return static_cast<float>(number);
    }

    /// A time or a length of time; leaves `seconds` as it is where the key is missing.
    Status read_seconds(const Json& object, const std::string& path, std::string_view key, float& seconds) const {
        const auto found = object.find(key);
        if (found == object.end()) return Done{};
        const Result<float> number = read_number(*found, member(path, key));
        if (!number) return number.error();
        if (*number < 0) return error(member(path, key) + ": " + found->dump() + " is less than 0 seconds");
        seconds = *number;
        return Done{};
    }

    Status read_channels(const Json& object, const std::string& path, std::vector<PerformanceChannel>& out) {
        const std::string place = member(path, "channels");
        const auto channels = object.find("channels");
        if (channels == object.end()) {
            return error(path.empty() ? "the key 'channels' is missing at the top level"
                                      : path + ": the key 'channels' is missing");
        }
        if (!channels->is_object()) return wrong_type(place, "an object", *channels);
        for (const auto& [name, channel] : channels->items()) {
            Result<Track> track = read_track(channel, member(place, shown(name)));
            if (!track) return track.error();
            out.push_back({.name = name, .track = *std::move(track)});
        }
        return Done{};
    }

    /// "loop" (true, or how many rounds) and "length" (of a round; the time of the last key where it is missing).
    Status read_loop(const Json& object, const std::string& path, const std::vector<PerformanceChannel>& channels,
                     Loop& loop) {
        for (const PerformanceChannel& channel : channels) {
            loop.length_seconds = std::max(loop.length_seconds, channel.track.times_seconds.back());
        }
        const auto found = object.find("loop");
        const bool loops = found != object.end() && *found != false;
        if (loops && *found == true) {
            loop.rounds = 0;
        } else if (loops) {
            constexpr std::int64_t most_rounds = 1'000'000;
            if (!found->is_number_integer() || *found < 1 || *found > most_rounds) {
                return error(member(path, "loop") + " must be true, false or a whole number from 1 to " +
                             std::to_string(most_rounds) + ", not " + shown(found->dump()));
            }
            loop.rounds = found->get<std::uint32_t>();
        }
        if (object.contains("length") && loop.rounds == 1) {
            performance_.notes.push_back(member(path, "length") + " counts for nothing without a loop");
            return Done{};
        }
        if (Status read = read_seconds(object, path, "length", loop.length_seconds); !read) return read.error();
        if (loop.rounds != 1 && !(loop.length_seconds > 0)) {
            return error(member(path, "loop") + ": a loop needs a length above 0 seconds: a second key, or 'length'");
        }
        return Done{};
    }

    Status read_layers(const Json& root) {
        const auto layers = root.find("layers");
        if (layers == root.end()) return Done{};
        if (!layers->is_array()) return wrong_type("layers", "an array", *layers);
        for (std::size_t i = 0; i < layers->size(); ++i) {
            if (Status read = read_layer((*layers)[i], entry("layers", i)); !read) return read;
        }
        return Done{};
    }

    Status read_layer(const Json& object, const std::string& path) {
        if (!object.is_object()) return wrong_type(path, "an object", object);
        PerformanceLayer layer;
        std::string mode = "add";
        if (Status read = read_text(object, path, "name", layer.name); !read) return read;
        if (Status read = read_text(object, path, "mode", mode); !read) return read;
        if (mode != "add" && mode != "override") {
            return error(path + ".mode: " + in_quotes(mode) + " is none of add, override");
        }
        layer.mode = mode == "add" ? LayerMode::add : LayerMode::override;
        if (Status read = read_seconds(object, path, "start", layer.start_seconds); !read) return read;
        if (Status read = read_channels(object, path, layer.channels); !read) return read;
        if (Status read = read_loop(object, path, layer.channels, layer.loop); !read) return read;
        Result<Track> weight = read_weight(object, path + ".weight");
        if (!weight) return weight.error();
        layer.weight = *std::move(weight);
        note_unknown_keys(object, path, {"name", "mode", "start", "loop", "length", "weight", "channels"});
        performance_.layers.push_back(std::move(layer));
        return Done{};
    }

    /// A number, or a track of its own; 1 where it is missing.
    Result<Track> read_weight(const Json& object, const std::string& path) {
        const auto found = object.find("weight");
        if (found != object.end() && found->is_object()) return read_track(*found, path);
        float weight = 1;
        if (found != object.end()) {
            const Result<float> number = read_number(*found, path);
            if (!number) return number.error();
            weight = *number;
        }
        return Track{.interpolation = Interpolation::step, .width = 1, .times_seconds = {0}, .values = {weight}};
    }

    Status read_markers(const Json& root) {
        const auto markers = root.find("markers");
        if (markers == root.end()) return Done{};
        if (!markers->is_array()) return wrong_type("markers", "an array", *markers);
        for (std::size_t i = 0; i < markers->size(); ++i) {
            const Json& object = (*markers)[i];
            const std::string path = entry("markers", i);
            if (!object.is_object()) return wrong_type(path, "an object", object);
            if (!object.contains("time")) return error(path + ": the key 'time' is missing");
            Marker marker;
            if (Status read = read_seconds(object, path, "time", marker.time_seconds); !read) return read;
            if (Status read = read_text(object, path, "event", marker.event); !read) return read;
            if (Status read = read_text(object, path, "text", marker.text); !read) return read;
            marker.text_seconds = marker.text.empty() ? 0 : reading_seconds(marker.text);
            if (Status read = read_seconds(object, path, "seconds", marker.text_seconds); !read) return read;
            if (marker.event.empty() && marker.text.empty()) {
                return error(path + ": needs an 'event', a 'text', or both");
            }
            note_unknown_keys(object, path, {"time", "event", "text", "seconds"});
            performance_.markers.push_back(std::move(marker));
        }
        std::ranges::stable_sort(performance_.markers, {}, &Marker::time_seconds);
        return Done{};
    }

    Result<Ease> read_ease(const Json& value, const std::string& path, std::string_view others) const {
        if (!value.is_string()) return wrong_type(path, "a string", value);
        const auto& name = value.get_ref<const std::string&>();
        if (const std::optional<Ease> ease = find_ease(name)) return *ease;
        return error(path + ": " + in_quotes(name) + " is none of " + std::string(ease_names) + std::string(others));
    }

    Result<Track> read_track(const Json& channel, const std::string& path) {
        if (!channel.is_object()) return wrong_type(path, "an object", channel);
        const auto interpolation = channel.find("interpolation");
        const bool cubic = interpolation != channel.end() && *interpolation == "cubic";
        Ease ease = Ease::smooth;
        if (interpolation != channel.end() && !cubic) {
            const Result<Ease> read = read_ease(*interpolation, path + ".interpolation", ", cubic");
            if (!read) return read.error();
            ease = *read;
        }
        const auto keys = channel.find("keys");
        if (keys == channel.end()) return error(path + ": the key 'keys' is missing");
        if (!keys->is_array()) return wrong_type(path + ".keys", "an array", *keys);
        if (keys->empty()) return error(path + ".keys is empty; a channel needs at least one key");
        note_unknown_keys(channel, path, {"interpolation", "keys"});

        Track track;
        track.interpolation = cubic ? Interpolation::cubic_spline : Interpolation::linear;
        track.times_seconds.reserve(keys->size());
        track.values.reserve(keys->size() * (cubic ? 3 : 1));
        std::vector<Ease> eases(cubic ? 0 : keys->size(), ease);
        for (std::size_t i = 0; i < keys->size(); ++i) {
            const Json& key = (*keys)[i];
            const bool well_formed = cubic ? add_cubic_key(key, track) : add_key(key, track, eases[i]);
            if (!well_formed) return fault_of_key(key, entry(path + ".keys", i), track);
        }
        return cubic ? track : eased_track(track, eases);
    }

    /// A number that may stand in a key; what does not is described by fault_of_key().
    static bool good(const Json& value) {
        return value.is_number() &&
               std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
    }
    static bool good_time(const Json& value, const Track& track) {
        if (!good(value)) return false;
        const float time = value.get<float>();
        return time >= 0 && (track.times_seconds.empty() || time > track.times_seconds.back());
    }

    /// [time, value] or [time, value, ease]. A path for every key of a million would cost more than the keys.
    static bool add_key(const Json& key, Track& track, Ease& ease) {
        if (!key.is_array() || key.size() < 2 || key.size() > 3) return false;
        if (!good_time(key[0], track) || !good(key[1])) return false;
        if (key.size() == 3) {
            const std::optional<Ease> own =
                key[2].is_string() ? find_ease(key[2].get_ref<const std::string&>()) : std::nullopt;
            if (!own) return false;
            ease = *own;
        }
        track.times_seconds.push_back(key[0].get<float>());
        track.values.push_back(key[1].get<float>());
        return true;
    }

    /// [time, value, in_tangent, out_tangent]
    static bool add_cubic_key(const Json& key, Track& track) {
        if (!key.is_array() || key.size() != 4 || !good_time(key[0], track)) return false;
        for (std::size_t i = 1; i < 4; ++i) {
            if (!good(key[i])) return false;
        }
        track.times_seconds.push_back(key[0].get<float>());
        track.values.insert(track.values.end(), {key[2].get<float>(), key[1].get<float>(), key[3].get<float>()});
        return true;
    }

    /// What add_key() or add_cubic_key() refused, in a sentence.
    Error fault_of_key(const Json& key, const std::string& path, const Track& track) const {
        const bool cubic = track.interpolation == Interpolation::cubic_spline;
        if (!key.is_array()) return wrong_type(path, "an array", key);
        if (cubic ? key.size() != 4 : key.size() < 2 || key.size() > 3) {
            return error(path + " must have " +
                         (cubic ? "4 numbers (time, value, in-tangent, out-tangent)"
                                : "2 numbers (time, value), perhaps with an ease") +
                         ", not " + std::to_string(key.size()) + (cubic ? "" : " entries"));
        }
        for (std::size_t i = 0; i < (cubic ? 4 : 2); ++i) {
            if (const Result<float> number = read_number(key[i], entry(path, i)); !number) return number.error();
        }
        if (good_time(key[0], track)) {
            const Result<Ease> ease = read_ease(key[2], entry(path, 2), "");
            assert(!ease && "a good key was refused");
            return ease.error();
        }
        if (key[0].get<float>() < 0) return error(entry(path, 0) + ": the time " + key[0].dump() + " is before 0");
        return error(entry(path, 0) + ": the time " + key[0].dump() + " does not come after that of the key before");
    }

    void find_duration() {
        float& duration = performance_.duration_seconds;
        duration = performance_.loop.end_seconds();
        for (const PerformanceLayer& layer : performance_.layers) {
            duration =
                std::max({duration, layer.start_seconds + layer.loop.end_seconds(), layer.weight.times_seconds.back()});
        }
        for (const Marker& marker : performance_.markers) {
            duration = std::max(duration, marker.time_seconds + marker.text_seconds);
        }
        // Times near the end of a float's range could add up to an infinity.
        duration = std::min(duration, std::numeric_limits<float>::max());
    }

    std::string file_;
    Performance performance_;
};

}  // namespace

Result<Performance> read_performance_json(std::string_view text, const std::string& file) {
    const Result<Json> root = parse_json(text, file, "a JSON performance");
    if (!root) return root.error();
    return Reader(file).read(*root);
}

}  // namespace blush
