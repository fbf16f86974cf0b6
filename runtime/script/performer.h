#pragma once
/// Performer: a timeline, a script, life and slow blood on one face, a moment at a time.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/motion/blood_flow.h"
#include "rig/motion/life.h"
#include "rig/motion/performance.h"
#include "rig/result.h"
#include "runtime/script/script.h"

namespace blush {

struct PerformerParts {
    std::vector<float> base;  ///< one value for each control: what nothing else drives; empty: all 0
    std::optional<BoundPerformance> timeline;
    std::optional<Script> script;  ///< not yet stepped
    std::optional<LifeSettings> life;
    std::optional<double> blood_speed;  ///< slow blood at that speed; without, blood follows the pose at once
    std::vector<Marker> events;         ///< from outside, beside the timeline's
};

/// Each control gets, in this order: its base value; what the timeline says; what the script holds; what life adds.
/// Then slow blood follows the pose.
///
/// Everything but the timeline, which has a value for every moment, goes on in steps of 1 / steps_a_second from time 0,
/// whatever the frame rate: so a moment looks the same whether it is played to or asked for, and in which frames. The
/// step is short enough that 24, 30, 48, 60 and 120 frames a second fall on steps. The rig must outlive it.
class Performer {
public:
    static constexpr int steps_a_second = 240;

    Performer(const Rig& rig, PerformerParts parts);
    Performer(Performer&&) noexcept;
    Performer& operator=(Performer&&) noexcept;
    ~Performer();

    /// Goes to a time (what is negative or not finite counts as 0); to an earlier one from the beginning. Error: the
    /// script's, once each time that it happens; the rest goes on, and the script's controls stay where they were.
    Status seek(double seconds);

    /// Writes all controls, and the nodes that the timeline moves (the others rest), of the time that was last sought.
    void write(std::span<float> controls, Pose& pose);
    /// Where the blood is; null where it follows the pose at once. Stays at its place until the performer goes.
    const BloodFlow* blood() const;

    /// Words to be seen now: the script's, else the timeline's; empty when there are none.
    std::string_view caption() const;
    /// When timeline, script and events have come to their ends; nothing for a script that does not do so within
    /// `most_seconds`. Runs the performer to find out, and leaves it at the beginning. Error: the script's.
    Result<std::optional<double>> find_end(double most_seconds);

    const std::optional<BoundPerformance>& timeline() const;
    bool still() const;  ///< no part of it moves: any moment is like the first

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace blush
