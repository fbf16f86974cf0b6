#pragma once
/// Life: what a face does without being told. Blinks, gaze, breath, small movements of the head.
///
/// Everything happens at moments drawn ahead from the seed, and every movement is a closed function of the time since
/// it began. So the same seed gives the same face at the same time whatever the steps were (but for the rounding of
/// their sum), and the same bits for the same steps on the same C library. Turning one part off does not change the
/// others.
///
/// Sources: "abstract" where the figure was checked there, else from memory.
/// - Blinks: 17 a minute at rest, 26 in conversation (Bentivoglio et al. 1997, abstract), at random with a pause after
///   each; closing about 92 ms, opening about 240 ms less what the lids rest, 334 ms in all (VanderWerf, Brassinga,
///   Reits, Aramideh, Ongerboer de Visser 2003). With a gaze shift, the more likely the larger it is, nearly always
///   beyond 33 degrees (Evinger, Manning, Pellegrini, Basso, Powers, Sibony 1994).
/// - Saccades: 21 ms and 2.2 ms a degree (Carpenter 1988), as a minimum-jerk movement, whose peak velocity then follows
///   the main sequence (Bahill, Clark, Stark 1975).
/// - Where and when: magnitudes, directions and the times of looking at and away in listening and talking (Lee, Badler,
///   Badler, Eyes Alive, 2002). While a face looks at its partner, it goes from eye to eye to mouth: ours.
/// - Vergence: both eyes turn to one point; pupils stand 63 mm apart (Dodgson 2004, the mean of adults).
/// - Head and eyes share a large gaze shift: what is beyond 10 degrees is the head's for the most part (after Stahl
/// 1999;
///   the share of 3/4 is ours); the eyes keep to their point while the head moves.
/// - Breath: 14 a minute, of 12 to 16 at rest; two fifths of it drawing in; the head rises a third of a degree: ours.
/// - Idle movement of the head: slow sines of about a degree, none in step with another: ours.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "rig/controls/rig.h"
#include "rig/random.h"

namespace blush {

struct LifeSettings {
    std::uint64_t seed = 1;
    bool blinks = true, gaze = true, breath = true, head = true;
    bool talking = false;          ///< looks away more often and longer, and blinks more
    double blinks_a_minute = 17;   ///< 1 to 60; 26 is usual where talking
    double breaths_a_minute = 14;  ///< 4 to 60
};

/// What is asked of it from outside.
struct LifeWish {
    bool look = false;                          ///< keeps the gaze on this direction; false: wherever it likes
    double yaw_radians = 0, pitch_radians = 0;  ///< of the gaze, signs as of Angles
    double distance_metres = 1;                 ///< of the point that both eyes look at; 0.05 at least
    std::uint32_t blinks = 0;                   ///< how many were asked for so far; one more begins one
};

/// A direction, as of Angles.
struct Gaze {
    double yaw_radians = 0, pitch_radians = 0;
};

/// From one direction to another, minimum jerk.
struct GazeMove {
    Gaze from, to;
    double start_seconds = 0, duration_seconds = 0;
    Gaze at(double seconds) const;
};

/// Times since its start at which a blink is closed, opens, and is over.
struct Blink {
    double start_seconds = -1e9, closed_seconds = 0.09, opening_seconds = 0.12, end_seconds = 0.334, depth = 1;
    /// How far the lids are down: 0 to 1.
    double at(double seconds) const;
};

/// Everything that step() changes. A plain value: copy it to come back to a moment.
struct LifeState {
    double seconds = 0;
    Random blink_random{0}, gaze_random{0}, breath_random{0};
    Blink blink;
    double next_blink_seconds = 0;
    GazeMove eyes, head;
    bool away = false;
    double next_gaze_seconds = 0, end_of_regard_seconds = 0;
    double breath_start_seconds = 0, breath_end_seconds = 0, breath_depth = 1;
    LifeWish wish;
    std::uint32_t blinks_begun = 0, saccades_begun = 0, breaths_begun = 0;
};

class Life {
public:
    Life(const Rig& rig, const LifeSettings& settings);

    const LifeState& state() const { return state_; }
    void restore(const LifeState& state) { state_ = state; }

    /// Goes on by `seconds` (what is negative or not finite counts as 0). No allocation.
    void step(double seconds, const LifeWish& wish = {});

    /// Adds what the face does now to controls, one value for each of the rig's: lids (of what is still open), eye
    /// shapes, angles of eyes and head; those that the rig has. No allocation.
    void add_to(std::span<float> controls) const;

    /// 0: empty, 1: drawn in.
    double breath() const;
    /// The head's own movement now.
    Angles head() const;

private:
    void begin_blink(double seconds);
    void plan_next_blink(double seconds);
    void look_at(Gaze to, double seconds);
    void next_gaze(double seconds);
    void begin_breath(double seconds);
    void heed(const LifeWish& wish);

    /// Two slow sines.
    struct Sway {
        std::array<double, 2> amplitude_radians{}, frequency_hertz{}, phase{};
        double at(double seconds) const;
    };

    LifeSettings settings_;
    LifeState state_;
    Sway yaw_, pitch_, roll_;
    /// blink, in, out, up, down; left, right.
    std::array<std::array<std::optional<ControlId>, 2>, 5> shapes_;
    std::array<std::array<std::optional<ControlId>, 2>, 2> eye_angles_;  ///< yaw, pitch; left, right
    std::array<std::optional<ControlId>, 3> head_angles_;
};

}  // namespace blush
