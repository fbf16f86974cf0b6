#include "rig/motion/blood_flow.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace blush {
namespace {

double moved(double from, double goal, const BloodTimes& times, double seconds) {
    const double time = goal > from ? times.rise_seconds : times.fall_seconds;
    if (!(time > 0)) return goal;
    // expm1 keeps its digits for steps that are short against the time.
    return from - (goal - from) * std::expm1(-seconds / time);
}

}  // namespace

BloodTimes blood_times(std::string_view map) {
    constexpr std::array<std::pair<std::string_view, BloodTimes>, 5> slow = {{{"blush", {7, 30}},
                                                                              {"pallor", {3, 15}},
                                                                              {"exercise", {60, 150}},
                                                                              {"alcohol", {600, 1800}},
                                                                              {"cold", {45, 90}}}};
    for (const auto& [name, times] : slow) {
        if (name == map) return times;
    }
    return {};
}

BloodTimes blood_factor_times() { return blood_times("blush"); }

BloodFlow::BloodFlow(std::span<const std::string> maps, double speed) : factor_times_(blood_factor_times()) {
    assert(speed > 0 && "BloodFlow: a speed above 0");
    const auto at_speed = [speed](BloodTimes times) {
        return BloodTimes{times.rise_seconds / speed, times.fall_seconds / speed};
    };
    for (const std::string& map : maps) times_.push_back(at_speed(blood_times(map)));
    factor_times_ = at_speed(factor_times_);
    state_.shares.assign(maps.size(), 0);
}

void BloodFlow::settle(const Pose& goal) {
    state_.shares.assign(goal.hemoglobin.begin(), goal.hemoglobin.end());
    state_.factor = static_cast<double>(goal.hemoglobin_factor);
}

void BloodFlow::step(double seconds, const Pose& goal) {
    assert(goal.hemoglobin.size() == times_.size() && "BloodFlow::step() takes a pose of the rig of its maps");
    if (!(seconds > 0) || !std::isfinite(seconds)) seconds = 0;
    for (std::size_t i = 0; i < times_.size(); ++i) {
        state_.shares[i] = moved(state_.shares[i], static_cast<double>(goal.hemoglobin[i]), times_[i], seconds);
    }
    state_.factor = moved(state_.factor, static_cast<double>(goal.hemoglobin_factor), factor_times_, seconds);
}

void BloodFlow::apply(Pose& pose) const {
    assert(pose.hemoglobin.size() == times_.size() && "BloodFlow::apply() takes a pose of the rig of its maps");
    double sum = 0;
    for (const double share : state_.shares) sum += share;
    const double scale = sum > 1 ? 1 / sum : 1;
    for (std::size_t i = 0; i < times_.size(); ++i) pose.hemoglobin[i] = static_cast<float>(state_.shares[i] * scale);
    pose.hemoglobin_factor = static_cast<float>(state_.factor);
}

}  // namespace blush
