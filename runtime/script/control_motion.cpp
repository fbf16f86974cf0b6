#include "runtime/script/control_motion.h"

#include <algorithm>
#include <cassert>

namespace blush {

double Motion::at(double seconds) const {
    if (!(seconds < start_seconds + over_seconds)) return to;
    if (!(seconds > start_seconds)) return from;
    const double share = ease_at(ease, (seconds - start_seconds) / over_seconds);
    return from + share * (to - from);
}

std::vector<ControlMotions::Held>::iterator ControlMotions::find(std::uint32_t control) {
    return std::ranges::lower_bound(held_, control, {}, &Held::control);
}
std::vector<ControlMotions::Held>::const_iterator ControlMotions::find(std::uint32_t control) const {
    return std::ranges::lower_bound(held_, control, {}, &Held::control);
}

double ControlMotions::mixed(const Held& held, double seconds, double below) {
    const double share = held.share.at(seconds), value = held.value.at(seconds);
    return share >= 1 ? value : below + share * (value - below);
}

void ControlMotions::move(std::uint32_t control, double to, double now_seconds, double over_seconds, Ease ease,
                          double below) {
    const double from = value(control, now_seconds, below);
    auto held = find(control);
    if (held == held_.end() || held->control != control)
        held = held_.insert(held, Held{.control = control, .value = {}});
    held->value = {from, to, now_seconds, over_seconds, ease};
    held->share = {.from = 1, .to = 1};
}

void ControlMotions::release(std::uint32_t control, double now_seconds, double over_seconds) {
    const auto held = find(control);
    if (held == held_.end() || held->control != control) return;
    held->share = {held->share.at(now_seconds), 0, now_seconds, over_seconds, Ease::ease_in_out};
}

bool ControlMotions::holds(std::uint32_t control) const {
    const auto held = find(control);
    return held != held_.end() && held->control == control;
}

double ControlMotions::value(std::uint32_t control, double seconds, double below) const {
    const auto held = find(control);
    return held == held_.end() || held->control != control ? below : mixed(*held, seconds, below);
}

void ControlMotions::apply(double seconds, std::span<float> controls) const {
    for (const Held& held : held_) {
        assert(held.control < controls.size() && "ControlMotions::apply() takes one value a control");
        float& control = controls[held.control];
        control = static_cast<float>(mixed(held, seconds, static_cast<double>(control)));
    }
}

void ControlMotions::tidy(double seconds) {
    std::erase_if(held_, [&](const Held& held) { return held.share.to == 0 && held.share.at(seconds) == 0; });
}

}  // namespace blush
