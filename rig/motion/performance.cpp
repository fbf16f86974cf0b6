#include "rig/motion/performance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "rig/motion/curve.h"

namespace blush {
namespace {

constexpr std::uint32_t no_control = std::numeric_limits<std::uint32_t>::max();

/// Component `k` of every key, as a track of its own. For a cubic spline a key has three blocks of `width`.
Track component_track(const Track& track, std::size_t k) {
    Track single{.interpolation = track.interpolation, .width = 1, .times_seconds = track.times_seconds, .values = {}};
    single.values.reserve(track.values.size() / track.width);
    for (std::size_t i = k; i < track.values.size(); i += track.width) single.values.push_back(track.values[i]);
    return single;
}

bool same(const Track& a, const Track& b) {
    return a.interpolation == b.interpolation && a.times_seconds == b.times_seconds && a.values == b.values;
}

std::string animation_label(const Animation& animation, std::size_t index) {
    return animation.name.empty() ? "animation " + std::to_string(index) : "animation '" + animation.name + "'";
}

float value_at(const Track& track, float time_seconds) {
    float value = 0;
    sample(track, time_seconds, {&value, 1});
    return value;
}

void add_layer(const PerformanceLayer& layer, std::span<const std::uint32_t> control_of_channel, float time_seconds,
               std::span<float> controls) {
    if (!(time_seconds >= layer.start_seconds)) return;
    const bool adds = layer.mode == LayerMode::add;
    const float given = value_at(layer.weight, time_seconds);
    const float weight = adds ? given : std::clamp(given, 0.0F, 1.0F);
    if (weight == 0) return;
    const float moment = layer.loop.moment(time_seconds - layer.start_seconds);
    for (std::size_t i = 0; i < control_of_channel.size(); ++i) {
        if (control_of_channel[i] == no_control) continue;
        float& control = controls[control_of_channel[i]];
        const float value = value_at(layer.channels[i].track, moment);
        control = adds ? control + weight * value : std::lerp(control, value, weight);
    }
}

/// Collects tracks by what they move. One that comes again takes the place of the earlier one.
class Merge {
public:
    explicit Merge(const Face& face) : face_(face) {}

    void add(const Animation& animation, std::size_t index) {
        replaced_ = 0;
        for (const WeightChannel& channel : animation.weights) {
            for (std::size_t k = 0; k < channel.targets.size(); ++k) {
                add_weight(channel.targets[k], component_track(channel.track, k));
            }
        }
        for (const NodeChannel& channel : animation.nodes) add_node(channel);
        if (replaced_ > 0) {
            result_.notes.push_back(animation_label(animation, index) + " replaces " + std::to_string(replaced_) +
                                    (replaced_ == 1 ? " earlier track" : " earlier tracks") +
                                    " of the same thing (first: " + first_replaced_ + ")");
        }
    }

    Performance take() && {
        for (const PerformanceChannel& channel : result_.channels) stretch(channel.track);
        for (const NodeChannel& channel : result_.nodes) stretch(channel.track);
        result_.loop.length_seconds = result_.duration_seconds;
        return std::move(result_);
    }

private:
    void add_weight(std::uint32_t target, Track track) {
        const std::string& name = face_.targets[target].name;
        const auto [entry, added] = channel_of_target_.try_emplace(target, result_.channels.size());
        if (added) {
            result_.channels.push_back({.name = name, .track = std::move(track)});
            return;
        }
        // Meshes that share a target repeat its curve: the same keys again are no conflict.
        Track& earlier = result_.channels[entry->second].track;
        if (!same(earlier, track)) count_replaced(name);
        earlier = std::move(track);
    }

    void add_node(const NodeChannel& channel) {
        const auto [entry, added] = channel_of_node_.try_emplace({channel.node, channel.path}, result_.nodes.size());
        if (added) {
            result_.nodes.push_back(channel);
            return;
        }
        NodeChannel& earlier = result_.nodes[entry->second];
        if (!same(earlier.track, channel.track)) count_replaced("node '" + face_.nodes[channel.node].name + "'");
        earlier = channel;
    }

    void count_replaced(const std::string& what) {
        if (replaced_++ == 0) first_replaced_ = what;
    }

    void stretch(const Track& track) {
        result_.duration_seconds = std::max(result_.duration_seconds, track.times_seconds.back());
    }

    const Face& face_;
    Performance result_;
    std::unordered_map<std::uint32_t, std::size_t> channel_of_target_;
    std::map<std::pair<std::uint32_t, NodePath>, std::size_t> channel_of_node_;
    std::size_t replaced_ = 0;
    std::string first_replaced_;
};

}  // namespace

float reading_seconds(std::string_view text) { return std::max(1.0F, static_cast<float>(text.size()) / 15); }

Performance performance_from_animations(const Face& face, std::optional<std::size_t> index) {
    Performance result;
    if (index && *index >= face.animations.size()) {
        result.notes.push_back(face.path + " has no animation " + std::to_string(*index) + ", only " +
                               std::to_string(face.animations.size()));
        return result;
    }
    const std::size_t first = index.value_or(0);
    const std::size_t end = index ? first + 1 : face.animations.size();
    Merge merge(face);
    for (std::size_t i = first; i < end; ++i) merge.add(face.animations[i], i);
    result = std::move(merge).take();
    result.name = end == first + 1 ? face.animations[first].name : "all animations";
    return result;
}

float Loop::moment(float seconds) const {
    if (rounds == 1) return seconds;
    if (!(seconds > 0) || !(length_seconds > 0)) return 0;
    if (rounds != 0 && seconds >= end_seconds()) return length_seconds;
    return std::isfinite(seconds) ? std::fmod(seconds, length_seconds) : length_seconds;
}

BoundPerformance::BoundPerformance(Performance performance, const Rig& rig) : performance_(std::move(performance)) {
    control_of_channel_ = bind(performance_.channels, rig, "");
    for (std::size_t i = 0; i < performance_.layers.size(); ++i) {
        const PerformanceLayer& layer = performance_.layers[i];
        const std::string name = layer.name.empty() ? "layer " + std::to_string(i) : "layer '" + layer.name + "'";
        controls_of_layer_.push_back(bind(layer.channels, rig, name + ": "));
    }
    std::unordered_set<std::string> seen;
    std::erase_if(unmatched_channels_, [&](const std::string& name) { return !seen.insert(name).second; });
    std::ranges::sort(driven_controls_);
    driven_controls_.erase(std::unique(driven_controls_.begin(), driven_controls_.end()), driven_controls_.end());

    if (driven_controls_.empty() || driven_controls_.front() < rig.target_count()) {
        std::vector<std::uint8_t> driven(rig.target_count(), 0);
        for (const std::uint32_t control : driven_controls_) {
            for (const std::uint32_t target : rig.reach(static_cast<ControlId>(control))) driven[target] = 1;
        }
        for (std::uint32_t i = 0; i < rig.target_count(); ++i) {
            if (driven[i] == 0) undriven_targets_.push_back(rig.control_names()[i]);
        }
    }
    // Node indices mean the face that they came from; on a smaller one those beyond its end have nothing to move.
    const std::size_t node_count = rig.rest_pose().nodes.size();
    const auto beyond = std::erase_if(performance_.nodes, [&](const NodeChannel& c) { return c.node >= node_count; });
    if (beyond > 0) {
        performance_.notes.push_back(std::to_string(beyond) + " node tracks move nodes that this face does not have");
    }
}

std::vector<std::uint32_t> BoundPerformance::bind(std::span<const PerformanceChannel> channels, const Rig& rig,
                                                  const std::string& place) {
    std::vector<std::uint32_t> controls;
    std::unordered_map<std::uint32_t, std::size_t> channel_of_control;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::string& name = channels[i].name;
        const std::optional<ControlId> control = rig.find(name);
        controls.push_back(control ? static_cast<std::uint32_t>(*control) : no_control);
        if (!control) {
            unmatched_channels_.push_back(name);
            continue;
        }
        driven_controls_.push_back(controls[i]);
        const auto [earlier, added] = channel_of_control.try_emplace(controls[i], i);
        if (added) continue;
        performance_.notes.push_back(place + "channels '" + channels[earlier->second].name + "' and '" + name +
                                     "' both drive '" + rig.control_names()[controls[i]] + "'; the last one plays");
        controls[earlier->second] = no_control;
        earlier->second = i;
    }
    return controls;
}

std::span<const Marker> BoundPerformance::markers_between(double from_seconds, double to_seconds) const {
    const auto& markers = performance_.markers;
    const auto after = [&](double seconds) {
        return std::ranges::upper_bound(markers, seconds, {},
                                        [](const Marker& m) { return static_cast<double>(m.time_seconds); });
    };
    const auto first = after(from_seconds), last = after(to_seconds);
    return first < last ? std::span<const Marker>(first, last) : std::span<const Marker>();
}

void BoundPerformance::sample(float time_seconds, std::span<float> controls, Pose& pose) const {
    const float moment = performance_.loop.moment(time_seconds);
    for (std::size_t i = 0; i < control_of_channel_.size(); ++i) {
        if (control_of_channel_[i] == no_control) continue;
        assert(control_of_channel_[i] < controls.size() && "BoundPerformance::sample() takes one value a control");
        blush::sample(performance_.channels[i].track, moment, controls.subspan(control_of_channel_[i], 1));
    }
    for (std::size_t i = 0; i < performance_.layers.size(); ++i) {
        add_layer(performance_.layers[i], controls_of_layer_[i], time_seconds, controls);
    }
    for (const NodeChannel& channel : performance_.nodes) {
        assert(channel.node < pose.nodes.size() && "BoundPerformance::sample() takes a pose of its own rig");
        Transform& node = pose.nodes[channel.node];
        glm::vec3& vector = channel.path == NodePath::scale ? node.scale : node.translation;
        if (channel.path == NodePath::rotation) {
            node.rotation = sample_rotation(channel.track, moment);
        } else {
            blush::sample(channel.track, moment, std::span<float>(&vector.x, 3));
        }
    }
}

}  // namespace blush
