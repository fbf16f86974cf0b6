#pragma once
/// BloodFlow: the slow flush and fade of blood, for those who want it.
///
/// jimenez-2012, 7.3.1, finding 6: blood that a deformation moves comes and goes with it, at once. That is what a Pose
/// says, and the default. What vessels do by dilating takes longer; this is a model of that: each share goes to where
/// the pose wants it at a rate in proportion to what is left, with one time for coming and one for going,
///     dx/dt = (goal - x) / (goal > x ? rise : fall),
/// solved exactly, so that a frame follows from (state, pose, dt) whatever the steps are.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig.h"

namespace blush {

/// After one of these times 63 % of the way is gone, after three 95 %. 0: at once.
struct BloodTimes {
    double rise_seconds = 0, fall_seconds = 0;
};

/// The times of a hemoglobin map by its name. All figures are from memory of what follows, rounded, and meant as a
/// start:
/// - blush 7 and 30: reddening is seen within some seconds and full after about 20; it lingers for a minute or two
///   (Shearn, Bergman, Hill, Abel, Hinds 1990; Drummond 2013, The psychophysiology of the blush);
/// - pallor 3 and 15: skin vessels close faster than they open (Kistler, Mariauzouls, von Berlepsch 1998, on fingers);
/// - exercise 60 and 150: flow in the skin rises with the body's heat and falls over minutes (Johnson 1992);
/// - alcohol 600 and 1800: as fast as it is taken up (jimenez-2012, 7.3, measured it over an hour);
/// - cold 45 and 90: of the same order as a cold face test's (Heath, Downey 1990).
/// Every other map, and with it every expression: 0 and 0 (finding 6).
BloodTimes blood_times(std::string_view map);
/// Of the factor on the whole face: that which anger and fear do to vessels (jimenez-2012, 7.7), a blush's times.
BloodTimes blood_factor_times();

/// Where the blood is. A plain value: copy it to come back to a moment.
struct BloodState {
    std::vector<double> shares;  ///< as Pose::hemoglobin, before all add up to no more than 1
    double factor = 1;
};

class BloodFlow {
public:
    /// The face at rest. `speed`: above 0; 10 lets a minute pass in six seconds.
    explicit BloodFlow(std::span<const std::string> maps, double speed = 1);

    const BloodState& state() const { return state_; }
    void restore(const BloodState& state) { state_ = state; }
    /// Where it ends when `goal` lasts: for a face that has blushed long since.
    void settle(const Pose& goal);

    /// Goes on by `seconds` (what is negative or not finite counts as 0) towards what an evaluated pose wants. No
    /// allocation.
    void step(double seconds, const Pose& goal);
    /// Writes hemoglobin and factor of a pose. Shares that add up to more than 1 all give way alike, as in a rig.
    void apply(Pose& pose) const;

private:
    std::vector<BloodTimes> times_;
    BloodTimes factor_times_;
    BloodState state_;
};

}  // namespace blush
