#include "runtime/script/performer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace blush {

struct Performer::State {
    State(const Rig& its_rig, PerformerParts its_parts) : rig(its_rig), parts(std::move(its_parts)) {
        const std::size_t count = rig.control_names().size();
        parts.base.resize(count, 0);
        below = controls = parts.base;
        rest = pose = rig.rest_pose();
        std::ranges::stable_sort(parts.events, {}, &Marker::time_seconds);
    }

    static double seconds_of(std::int64_t step) { return static_cast<double>(step) / steps_a_second; }

    void restart() {
        steps_done = -1;
        life.reset();
        if (parts.life) life.emplace(rig, *parts.life);
        if (!parts.life && parts.script) life.emplace(rig, no_life());  // looks and blinks that the script asks for
        blood.reset();
        if (parts.blood_speed) blood.emplace(rig.hemoglobin_maps(), *parts.blood_speed);
        // The text has compiled before; a restart can only fail for want of memory, and then as an error of the script.
        if (parts.script && script_used) restart_error = parts.script->restart();
        script_used = false;
    }

    static LifeSettings no_life() { return {.blinks = false, .gaze = false, .breath = false, .head = false}; }

    void sample_below(double at_seconds) {
        std::ranges::copy(parts.base, below.begin());
        if (parts.timeline) parts.timeline->sample(static_cast<float>(at_seconds), below, pose);
    }

    void hear_events(double from_seconds, double to_seconds) {
        const auto hear = [&](const Marker& marker) {
            if (!marker.event.empty()) {
                parts.script->emit(marker.event, marker.text, static_cast<double>(marker.time_seconds));
            }
        };
        if (parts.timeline) {
            for (const Marker& marker : parts.timeline->markers_between(from_seconds, to_seconds)) hear(marker);
        }
        for (const Marker& marker : parts.events) {
            const auto at = static_cast<double>(marker.time_seconds);
            if (at > from_seconds && at <= to_seconds) hear(marker);
        }
    }

    /// One step, to seconds_of(steps_done + 1). The first one has no length.
    Status step() {
        const std::int64_t number = steps_done + 1;
        const double seconds = number == 0 ? 0 : 1.0 / steps_a_second;
        const double now = seconds_of(number);
        steps_done = number;
        Status result = Done{};
        if (parts.script) {
            sample_below(now);
            hear_events(number == 0 ? -1 : seconds_of(number - 1), now);
            script_used = true;
            result = std::exchange(restart_error, Done{});
            if (result) result = parts.script->step(seconds, below);
        }
        if (life) life->step(seconds, wish());
        if (blood) {
            // Blood needs the pose of every step; without it, a frame that nobody sees costs no evaluation.
            if (!parts.script) sample_below(now);
            std::ranges::copy(below, controls.begin());
            finish(controls);
            rig.evaluate(controls, pose);
            blood->step(seconds, pose);
        }
        return result;
    }

    LifeWish wish() const {
        LifeWish wish;
        if (!parts.script) return wish;
        const GazeWish& gaze = parts.script->gaze();
        wish.look = gaze.wished;
        wish.yaw_radians = gaze.yaw_radians;
        wish.pitch_radians = gaze.pitch_radians;
        wish.distance_metres = gaze.distance_metres;
        wish.blinks = parts.script->blinks_wished();
        return wish;
    }

    void finish(std::span<float> out) {
        if (parts.script) parts.script->apply(out);
        if (life) life->add_to(out);
    }

    const Rig& rig;
    PerformerParts parts;
    std::optional<Life> life;
    std::optional<BloodFlow> blood;
    std::vector<float> below, controls;
    Pose rest, pose;
    std::int64_t steps_done = -1;
    double sought_seconds = 0;
    bool script_used = false;
    Status restart_error = Done{};
};

Performer::Performer(const Rig& rig, PerformerParts parts) : state_(std::make_unique<State>(rig, std::move(parts))) {
    state_->restart();
}
Performer::Performer(Performer&&) noexcept = default;
Performer& Performer::operator=(Performer&&) noexcept = default;
Performer::~Performer() = default;

Status Performer::seek(double seconds) {
    constexpr double most_seconds = 1e7;  // beyond that, steps could not be counted by their time any more
    State& state = *state_;
    seconds = std::isfinite(seconds) ? std::clamp(seconds, 0.0, most_seconds) : 0.0;
    state.sought_seconds = seconds;
    if (!state.parts.script && !state.life && !state.blood) return Done{};
    // A time that was computed as a number of frames may lie a rounding error below its step.
    const auto wanted = static_cast<std::int64_t>(std::floor(seconds * steps_a_second + 1e-6));
    if (wanted < state.steps_done) state.restart();
    Status first_error = Done{};
    while (state.steps_done < wanted) {
        Status stepped = state.step();
        if (!stepped && first_error) first_error = std::move(stepped);
    }
    return first_error;
}

void Performer::write(std::span<float> controls, Pose& pose) {
    State& state = *state_;
    std::ranges::copy(state.parts.base, controls.begin());
    std::ranges::copy(state.rest.nodes, pose.nodes.begin());
    if (state.parts.timeline) state.parts.timeline->sample(static_cast<float>(state.sought_seconds), controls, pose);
    state.finish(controls);
}

const BloodFlow* Performer::blood() const { return state_->blood ? &*state_->blood : nullptr; }

std::string_view Performer::caption() const {
    const State& state = *state_;
    if (state.parts.script && !state.parts.script->caption().empty()) return state.parts.script->caption();
    if (!state.parts.timeline) return "";
    std::string_view words;
    for (const Marker& marker : state.parts.timeline->markers_between(-1, state.sought_seconds)) {
        if (marker.text.empty()) continue;
        const double end = static_cast<double>(marker.time_seconds) + static_cast<double>(marker.text_seconds);
        words = state.sought_seconds < end ? std::string_view(marker.text) : "";
    }
    return words;
}

Result<std::optional<double>> Performer::find_end(double most_seconds) {
    State& state = *state_;
    double end = state.parts.timeline ? static_cast<double>(state.parts.timeline->duration_seconds()) : 0;
    if (state.parts.script) {
        double last_event = end;
        for (const Marker& marker : state.parts.events) {
            last_event = std::max(last_event, static_cast<double>(marker.time_seconds));
        }
        Script& script = *state.parts.script;
        script.mute();
        constexpr double look_seconds = 0.25;
        double now = 0;
        for (; now <= most_seconds; now += look_seconds) {
            if (Status played = seek(now); !played) {
                state.restart();
                return played.error();
            }
            if (script.ended() && now >= last_event) break;
        }
        const bool ended = script.ended();
        end = std::max({end, last_event, script.settled_seconds()});
        state.restart();
        state.sought_seconds = 0;
        if (!ended) return std::optional<double>();
    }
    return std::optional<double>(end);
}

const std::optional<BoundPerformance>& Performer::timeline() const { return state_->parts.timeline; }
bool Performer::still() const {
    const State& state = *state_;
    return !state.parts.script && !state.life && !state.blood &&
           (!state.parts.timeline || state.parts.timeline->duration_seconds() == 0);
}

}  // namespace blush
