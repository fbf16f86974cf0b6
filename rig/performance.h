#pragma once
/// Performance: keyed channels over time, and its binding to one face.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rig/face.h"
#include "rig/rig.h"

namespace blush {

/// One named channel: `track` has width 1 and drives the control of that name.
struct PerformanceChannel {
    std::string name;
    Track track;
};

struct Performance {
    std::string name;
    float duration_seconds = 0;  ///< time of the last key; 0 for a still
    std::vector<PerformanceChannel> channels;
    std::vector<NodeChannel> nodes;  ///< glTF only: indices into Face::nodes of the face that it came from
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
    /// Targets of the face that no channel drives, in file order.
    std::span<const std::string> undriven_targets() const { return undriven_targets_; }

    /// Writes the controls that the performance drives (the others stay as they are) and the nodes that it moves.
    /// `controls` has one value for each control of the rig. No allocation.
    void sample(float time_seconds, std::span<float> controls, Pose& pose) const;

private:
    Performance performance_;
    std::vector<std::uint32_t> control_of_channel_;  ///< no_control where none matches
    std::vector<std::string> unmatched_channels_, undriven_targets_;
};

}  // namespace blush
