#pragma once
/// What a script does to controls over time: each has a value that is on its way to another.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/motion/ease.h"

namespace blush {

/// From one value to another within a stretch of time; afterwards it holds.
struct Motion {
    double from = 0, to = 0, start_seconds = 0, over_seconds = 0;
    Ease ease = Ease::ease_in_out;

    double at(double seconds) const;
};

/// The controls that a script holds. What it does not hold keeps the value that lies below (a timeline's, a user's).
/// A plain value: copy it to come back to a moment.
class ControlMotions {
public:
    /// Takes hold of a control, or turns it to another value from wherever it is at `now_seconds`. `below`: the value
    /// that it has when nothing holds it.
    void move(std::uint32_t control, double to, double now_seconds, double over_seconds, Ease ease, double below);
    /// Lets a control go back to what lies below, within a stretch of time.
    void release(std::uint32_t control, double now_seconds, double over_seconds);
    bool holds(std::uint32_t control) const;
    double value(std::uint32_t control, double seconds, double below) const;

    /// Writes the controls that are held; no allocation.
    void apply(double seconds, std::span<float> controls) const;
    /// Forgets what has been let go.
    void tidy(double seconds);

private:
    struct Held {
        std::uint32_t control = 0;
        Motion value;
        Motion share{.from = 1, .to = 1};  ///< of `value`; the rest is what lies below
    };
    std::vector<Held>::iterator find(std::uint32_t control);
    std::vector<Held>::const_iterator find(std::uint32_t control) const;
    static double mixed(const Held& held, double seconds, double below);

    std::vector<Held> held_;  ///< ascending by control
};

}  // namespace blush
