#pragma once
/// A performance on a character: found by name, bound, sampled.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "rig/performance.h"
#include "runtime/character.h"

namespace blush::tool {

/// Finds a performance for a face: nothing named: the file's own animations, or for a face without any the shipped
/// "first_light"; else an animation of the file by its name, a shipped performance by its name, or a file.
/// Error: nothing of that name, with what there is.
Result<Performance> find_performance(const Face& face, const std::string& name);

/// Names once every channel without a control and every target without a channel, and the performance's own notes, on
/// standard error.
void report_matches(const BoundPerformance& performance, const Face& face);

/// Sets the character to the performance at a time. Controls that the performance does not drive keep `base`, nodes
/// that it does not move rest.
class Playback {
public:
    Playback(Character& character, BoundPerformance performance)
        : character_(&character),
          performance_(std::move(performance)),
          base_(character.controls().begin(), character.controls().end()),
          rest_(character.rig().rest_pose()) {}

    const BoundPerformance& performance() const { return performance_; }
    void seek(float time_seconds);

private:
    Character* character_;
    BoundPerformance performance_;
    std::vector<float> base_;
    Pose rest_;
};

}  // namespace blush::tool
