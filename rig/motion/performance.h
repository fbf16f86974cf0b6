#pragma once
/// Performance: keyed channels over time, and its binding to one face.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/face.h"

namespace blush {

/// One named channel: `track` has width 1 and drives the control of that name.
struct PerformanceChannel {
    std::string name;
    Track track;
};

/// How often a stretch of time is played: 1 is once; 0 is for ever.
struct Loop {
    float length_seconds = 0;  ///< of one round; 0 for a still
    std::uint32_t rounds = 1;

    /// The moment within a round that stands at `seconds` since the first one began: the end of a round is the start of
    /// the next, and the end of the last one holds. With one round, `seconds` itself: curves hold at their own ends.
    float moment(float seconds) const;
    /// When the last round ends; of a loop for ever, when the first one does.
    float end_seconds() const { return length_seconds * static_cast<float>(rounds == 0 ? 1 : rounds); }
};

enum class LayerMode : std::uint8_t {
    add,       ///< the layer's values times its weight come on top of what lies below
    override,  ///< the layer's values take the place of what lies below, as far as its weight (0 to 1) goes
};

/// Channels that play over what lies below them. Before `start_seconds` a layer counts for nothing.
struct PerformanceLayer {
    std::string name;
    LayerMode mode = LayerMode::add;
    float start_seconds = 0;  ///< of the performance, where the layer's own time begins
    Loop loop;
    Track weight;  ///< width 1, over the performance's time; it does not loop
    std::vector<PerformanceChannel> channels;
};

/// Something that happens at a moment: an event that scripts hear, a caption, or both.
struct Marker {
    float time_seconds = 0;
    std::string event;  ///< empty: none
    std::string text;   ///< words to be seen; empty: none
    float text_seconds = 0;
};

/// How long words should be seen: about 15 characters a second are read with ease (subtitling practice), and nothing in
/// less than a second.
float reading_seconds(std::string_view text);

struct Performance {
    std::string name;
    float duration_seconds = 0;  ///< when everything has come to its end (a loop for ever: after one round); 0: a still
    Loop loop;                   ///< of `channels` and `nodes`, not of layers and markers
    std::vector<PerformanceChannel> channels;
    std::vector<PerformanceLayer> layers;  ///< each over those before it
    std::vector<Marker> markers;           ///< in ascending order of time
    std::vector<NodeChannel> nodes;        ///< glTF only: indices into Face::nodes of the face that it came from
    std::vector<std::string>
        notes;  ///< what the reader skipped or mended ("3 dropped frames after row 120"), one sentence each
};

/// Takes one of the face's own animations, or all of them at once when `index` is empty, as a performance: one channel
/// a target, named after it. What several animations move takes the last one's track, with a note. An index that the
/// face does not have gives a performance without channels and a note.
Performance performance_from_animations(const Face& face, std::optional<std::size_t> index);

/// A performance whose names have been resolved against a rig, once.
class BoundPerformance {
public:
    /// Several channels that mean one control: the last wins, with a note.
    BoundPerformance(Performance performance, const Rig& rig);

    float duration_seconds() const { return performance_.duration_seconds; }
    const Performance& performance() const { return performance_; }
    /// Channels that no control of the face matches, in file order.
    std::span<const std::string> unmatched_channels() const { return unmatched_channels_; }
    /// Targets of the face that no channel drives, in file order; none for a performance that drives no target by its
    /// own name (it moves them through emotions, action units, ...).
    std::span<const std::string> undriven_targets() const { return undriven_targets_; }
    /// The controls that sample() writes, ascending.
    std::span<const std::uint32_t> driven_controls() const { return driven_controls_; }
    /// Markers with from_seconds < time <= to_seconds.
    std::span<const Marker> markers_between(double from_seconds, double to_seconds) const;

    /// Writes the controls that the performance drives (the others stay as they are) and the nodes that it moves.
    /// `controls` has one value for each control of the rig. No allocation.
    void sample(float time_seconds, std::span<float> controls, Pose& pose) const;

private:
    /// Controls of a list of channels; no_control where none matches.
    std::vector<std::uint32_t> bind(std::span<const PerformanceChannel> channels, const Rig& rig,
                                    const std::string& place);

    Performance performance_;
    std::vector<std::uint32_t> control_of_channel_;
    std::vector<std::vector<std::uint32_t>> controls_of_layer_;
    std::vector<std::uint32_t> driven_controls_;
    std::vector<std::string> unmatched_channels_, undriven_targets_;
};

}  // namespace blush
