#include "rig/motion/life.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

namespace blush {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double radians_a_degree = pi / 180;

/// Pupils stand 63 mm apart (Dodgson 2004).
constexpr double half_pupil_distance_metres = 0.0315;
/// Face to face (Hall 1966: personal distance, 0.5 to 1.2 m).
constexpr double partner_distance_metres = 1;
/// An eye shape of 1 goes with these angles in recordings of Live Link Face.
constexpr double yaw_of_shape_radians = 0.6, pitch_of_shape_radians = 0.55;
/// How far eyes turn in their sockets with ease (Guitton, Volle 1987: about 40 degrees at most).
constexpr double most_eye_radians = 35 * radians_a_degree;

double length_of(Gaze gaze) { return std::hypot(gaze.yaw_radians, gaze.pitch_radians); }
Gaze minus(Gaze a, Gaze b) { return {a.yaw_radians - b.yaw_radians, a.pitch_radians - b.pitch_radians}; }

/// 0 to 1 without a jerk at either end (Flash, Hogan 1985).
double minimum_jerk(double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * u * (10 + u * (6 * u - 15));
}

/// Mean and least length of a regard: the mean and standard deviation of Lee et al. 2002, in frames of 1/30 s, as a
/// pause and a random wait, whose deviation is its mean.
struct Regard {
    double least_seconds, waiting_seconds;
};
constexpr Regard regard_of(double mean_frames, double deviation_frames) {
    return {std::max(3.0, mean_frames - deviation_frames) / 30,
            (mean_frames - std::max(3.0, mean_frames - deviation_frames)) / 30};
}
constexpr Regard listening_at = regard_of(237.5, 47.1), listening_away = regard_of(13.0, 7.1);
constexpr Regard talking_at = regard_of(93.9, 94.9), talking_away = regard_of(27.8, 24.0);

/// Shares of the eight directions, from the own left upwards and round (Lee et al. 2002, table 1), per cent.
constexpr std::array<double, 8> direction_shares = {15.54, 6.46, 17.69, 7.44, 16.80, 7.89, 20.38, 7.79};

/// A saccade's direction and size (Lee et al. 2002: A = -6.9 ln(P / 15.7) degrees, P from 0 to 15 per cent, 27.5 at
/// most).
Gaze random_saccade(Random& random) {
    double place = random.between(0, 100);
    std::size_t direction = 0;
    while (direction + 1 < direction_shares.size() && place >= direction_shares[direction]) {
        place -= direction_shares[direction++];
    }
    const double angle = static_cast<double>(direction) * pi / 4;
    const double size_degrees = std::min(27.5, -6.9 * std::log(random.between(1e-3, 15) / 15.7));
    // Up is negative pitch.
    return {size_degrees * std::cos(angle) * radians_a_degree, -size_degrees * std::sin(angle) * radians_a_degree};
}

std::optional<ControlId> find_side(const Rig& rig, const std::string& name, bool left) {
    return rig.find(name + (left ? "Left" : "Right"));
}

}  // namespace

Gaze GazeMove::at(double seconds) const {
    const double share = duration_seconds > 0 ? minimum_jerk((seconds - start_seconds) / duration_seconds)
                                              : (seconds >= start_seconds ? 1.0 : 0.0);
    return {from.yaw_radians + share * (to.yaw_radians - from.yaw_radians),
            from.pitch_radians + share * (to.pitch_radians - from.pitch_radians)};
}

double Blink::at(double seconds) const {
    const double since = seconds - start_seconds;
    if (!(since > 0) || since >= end_seconds) return 0;
    if (since < closed_seconds) return depth * minimum_jerk(since / closed_seconds);
    if (since < opening_seconds) return depth;
    // The lids start up fast and come to rest slowly: 1, level, at the beginning; 0, level, at the end.
    const double left = (end_seconds - since) / (end_seconds - opening_seconds);
    return depth * left * left * left * (4 - 3 * left);
}

double Life::Sway::at(double seconds) const {
    double sum = 0;
    for (std::size_t i = 0; i < amplitude_radians.size(); ++i) {
        sum += amplitude_radians[i] * std::sin(2 * pi * (frequency_hertz[i] * seconds + phase[i]));
    }
    return sum;
}

Life::Life(const Rig& rig, const LifeSettings& settings) : settings_(settings) {
    settings_.blinks_a_minute = std::clamp(settings.blinks_a_minute, 1.0, 60.0);
    settings_.breaths_a_minute = std::clamp(settings.breaths_a_minute, 4.0, 60.0);
    // A stream a part, so that turning one off leaves the others alone.
    Random seeds(settings.seed);
    state_.blink_random = Random(seeds.bits());
    state_.gaze_random = Random(seeds.bits());
    state_.breath_random = Random(seeds.bits());
    Random sway(seeds.bits());
    const auto make_sway = [&sway](std::array<double, 2> amplitudes_degrees, std::array<double, 2> frequencies) {
        Sway made;
        for (std::size_t i = 0; i < 2; ++i) {
            made.amplitude_radians[i] = amplitudes_degrees[i] * radians_a_degree;
            made.frequency_hertz[i] = frequencies[i] * sway.between(0.85, 1.15);
            made.phase[i] = sway.unit();
        }
        return made;
    };
    yaw_ = make_sway({1.1, 0.4}, {0.067, 0.19});
    pitch_ = make_sway({0.7, 0.3}, {0.089, 0.23});
    roll_ = make_sway({0.5, 0.25}, {0.059, 0.17});

    constexpr std::array<const char*, 5> shape_names = {"eyeBlink", "eyeLookIn", "eyeLookOut", "eyeLookUp",
                                                        "eyeLookDown"};
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t s = 0; s < shape_names.size(); ++s) {
            shapes_[s][side] = find_side(rig, shape_names[s], side == 0);
        }
        const std::string eye = side == 0 ? "leftEye" : "rightEye";
        eye_angles_[0][side] = rig.find(eye + "Yaw");
        eye_angles_[1][side] = rig.find(eye + "Pitch");
    }
    head_angles_ = {rig.find("headYaw"), rig.find("headPitch"), rig.find("headRoll")};

    plan_next_blink(0);
    state_.end_of_regard_seconds = 0;
    state_.next_gaze_seconds = state_.gaze_random.between(0.3, 1.2);
    begin_breath(0);
    state_.wish.distance_metres = partner_distance_metres;
}

void Life::plan_next_blink(double seconds) {
    // Lids that have just opened stay open for a moment; then a blink comes at random.
    constexpr double pause_seconds = 0.6;
    const double talking = settings_.talking ? 26.0 / 17 : 1.0;
    const double mean = 60 / (settings_.blinks_a_minute * talking);
    state_.next_blink_seconds =
        seconds + pause_seconds + state_.blink_random.waiting(std::max(0.1, mean - pause_seconds));
}

void Life::begin_blink(double seconds) {
    Random& random = state_.blink_random;
    if (seconds < state_.blink.start_seconds + state_.blink.end_seconds) return;  // the lids are on their way
    Blink blink;
    blink.start_seconds = seconds;
    blink.closed_seconds = random.between(0.078, 0.106);
    blink.opening_seconds = blink.closed_seconds + random.between(0.015, 0.045);
    blink.end_seconds = blink.opening_seconds + random.between(0.16, 0.26);
    // One in six does not close quite.
    blink.depth = random.unit() < 1.0 / 6 ? random.between(0.7, 0.95) : 1;
    state_.blink = blink;
    ++state_.blinks_begun;
    plan_next_blink(seconds);
}

void Life::look_at(Gaze to, double seconds) {
    const Gaze from = state_.eyes.at(seconds);
    const double size_degrees = length_of(minus(to, from)) / radians_a_degree;
    if (!(size_degrees > 1e-6)) return;
    state_.eyes = {from, to, seconds, 0.021 + 0.0022 * size_degrees};
    ++state_.saccades_begun;

    const double eccentricity_degrees = length_of(to) / radians_a_degree;
    constexpr double eyes_alone_degrees = 10, share_of_head = 0.75;
    const double share = eccentricity_degrees > eyes_alone_degrees
                             ? share_of_head * (eccentricity_degrees - eyes_alone_degrees) / eccentricity_degrees
                             : 0;
    const Gaze head_to = {share * to.yaw_radians, share * to.pitch_radians}, head_from = state_.head.at(seconds);
    const double head_degrees = length_of(minus(head_to, head_from)) / radians_a_degree;
    // The head sets out a little later than the eyes and takes several times as long.
    if (head_degrees > 1e-6) state_.head = {head_from, head_to, seconds + 0.04, 0.35 + 0.012 * head_degrees};

    if (!settings_.blinks) return;
    const double chance = std::clamp((size_degrees - 5) / (33 - 5), 0.0, 1.0) * 0.97;
    if (state_.blink_random.unit() < chance) begin_blink(seconds);
}

void Life::next_gaze(double seconds) {
    Random& random = state_.gaze_random;
    if (seconds >= state_.end_of_regard_seconds) {
        state_.away = !state_.away;
        if (state_.saccades_begun == 0) state_.away = false;  // a face begins by looking at its partner
        const Regard regard = state_.away ? (settings_.talking ? talking_away : listening_away)
                                          : (settings_.talking ? talking_at : listening_at);
        state_.end_of_regard_seconds = seconds + regard.least_seconds + random.waiting(regard.waiting_seconds);
        if (state_.away) {
            const Gaze turned = random_saccade(random);
            // Lids and brows leave less room up and down than to the sides.
            constexpr double most_yaw = 27.5 * radians_a_degree, most_pitch = 18 * radians_a_degree;
            look_at({std::clamp(turned.yaw_radians, -most_yaw, most_yaw),
                     std::clamp(turned.pitch_radians, -most_pitch, most_pitch)},
                    seconds);
            state_.next_gaze_seconds = state_.end_of_regard_seconds;
            return;
        }
    }
    // The partner's left eye, right eye, mouth.
    const double place = random.unit();
    const double side = std::atan2(half_pupil_distance_metres, partner_distance_metres);
    constexpr double eyes_to_mouth_metres = 0.07;
    const double down = std::atan2(eyes_to_mouth_metres, partner_distance_metres);
    look_at(place < 0.4 ? Gaze{side, 0} : place < 0.8 ? Gaze{-side, 0} : Gaze{0, down}, seconds);
    state_.next_gaze_seconds = std::min(state_.end_of_regard_seconds, seconds + 0.25 + random.waiting(0.75));
}

void Life::begin_breath(double seconds) {
    Random& random = state_.breath_random;
    state_.breath_start_seconds = seconds;
    state_.breath_end_seconds = seconds + 60 / settings_.breaths_a_minute * random.between(0.88, 1.12);
    state_.breath_depth = random.between(0.8, 1.2);
    ++state_.breaths_begun;
}

void Life::heed(const LifeWish& wish) {
    const LifeWish before = state_.wish;
    state_.wish = wish;
    state_.wish.distance_metres = std::max(0.05, wish.look ? wish.distance_metres : partner_distance_metres);
    const double now = state_.seconds;
    if (wish.blinks != before.blinks) begin_blink(now);
    if (wish.look) {
        const bool same =
            before.look && before.yaw_radians == wish.yaw_radians && before.pitch_radians == wish.pitch_radians;
        if (!same) look_at({wish.yaw_radians, wish.pitch_radians}, now);
    } else if (before.look) {
        look_at({0, 0}, now);
        state_.away = false;
        state_.end_of_regard_seconds = now + (settings_.talking ? talking_at : listening_at).least_seconds;
        state_.next_gaze_seconds = now + 0.5;
    }
}

void Life::step(double seconds, const LifeWish& wish) {
    heed(wish);
    constexpr double never = std::numeric_limits<double>::infinity();
    const double end_seconds = state_.seconds + (seconds > 0 && std::isfinite(seconds) ? seconds : 0);
    while (true) {
        const double blink = settings_.blinks ? state_.next_blink_seconds : never;
        const double gaze = settings_.gaze && !state_.wish.look ? state_.next_gaze_seconds : never;
        const double breath = settings_.breath ? state_.breath_end_seconds : never;
        const double next = std::min({blink, gaze, breath});
        if (next > end_seconds) break;
        if (next == blink) {
            // One that comes while the lids move is put off by them.
            plan_next_blink(next);
            begin_blink(next);
        } else if (next == gaze) {
            next_gaze(next);
        } else {
            begin_breath(next);
        }
    }
    state_.seconds = end_seconds;
}

double Life::breath() const {
    if (!settings_.breath) return 0;
    const double u =
        (state_.seconds - state_.breath_start_seconds) / (state_.breath_end_seconds - state_.breath_start_seconds);
    constexpr double drawing_in = 0.4;
    return state_.breath_depth *
           (u < drawing_in ? minimum_jerk(u / drawing_in) : 1 - minimum_jerk((u - drawing_in) / (1 - drawing_in)));
}

Angles Life::head() const {
    const double now = state_.seconds;
    const Gaze turned = state_.head.at(now);
    double yaw = turned.yaw_radians, pitch = turned.pitch_radians, roll = 0;
    if (settings_.head) {
        // The first two seconds lead from a face at rest into its movement.
        const double begun = minimum_jerk(now / 2);
        yaw += begun * yaw_.at(now);
        pitch += begun * pitch_.at(now);
        roll += begun * roll_.at(now);
    }
    constexpr double breath_radians = 0.33 * radians_a_degree;
    pitch -= breath_radians * breath();
    return {static_cast<float>(yaw), static_cast<float>(pitch), static_cast<float>(roll)};
}

void Life::add_to(std::span<float> controls) const {
    const auto add = [&](std::optional<ControlId> control, double value) {
        if (!control) return;
        assert(static_cast<std::size_t>(*control) < controls.size() && "Life::add_to() takes one value a control");
        controls[static_cast<std::size_t>(*control)] += static_cast<float>(value);
    };
    const double now = state_.seconds;
    const Angles head_now = head();
    add(head_angles_[0], static_cast<double>(head_now.yaw_radians));
    add(head_angles_[1], static_cast<double>(head_now.pitch_radians));
    add(head_angles_[2], static_cast<double>(head_now.roll_radians));

    const double lids = state_.blink.at(now);
    for (std::size_t side = 0; lids > 0 && side < 2; ++side) {
        if (!shapes_[0][side]) continue;
        const float down = controls[static_cast<std::size_t>(*shapes_[0][side])];
        add(shapes_[0][side], lids * (1 - std::clamp(static_cast<double>(down), 0.0, 1.0)));
    }

    if (!settings_.gaze && !state_.wish.look && state_.saccades_begun == 0) return;
    const Gaze gaze = state_.eyes.at(now);
    const double distance = state_.wish.distance_metres;
    const double ahead = distance * std::cos(gaze.pitch_radians) * std::cos(gaze.yaw_radians);
    const double to_left = distance * std::cos(gaze.pitch_radians) * std::sin(gaze.yaw_radians);
    for (std::size_t side = 0; side < 2; ++side) {
        const double eye = side == 0 ? half_pupil_distance_metres : -half_pupil_distance_metres;
        // The point as this eye sees it, less what the head has turned already.
        const double yaw = std::clamp(std::atan2(to_left - eye, ahead) - static_cast<double>(head_now.yaw_radians),
                                      -most_eye_radians, most_eye_radians);
        const double pitch = std::clamp(gaze.pitch_radians - static_cast<double>(head_now.pitch_radians),
                                        -most_eye_radians, most_eye_radians);
        add(eye_angles_[0][side], yaw);
        add(eye_angles_[1][side], pitch);
        const double inward = side == 0 ? -yaw : yaw;
        add(shapes_[1][side], std::max(0.0, inward) / yaw_of_shape_radians);
        add(shapes_[2][side], std::max(0.0, -inward) / yaw_of_shape_radians);
        add(shapes_[3][side], std::max(0.0, -pitch) / pitch_of_shape_radians);
        add(shapes_[4][side], std::max(0.0, pitch) / pitch_of_shape_radians);
    }
}

}  // namespace blush
