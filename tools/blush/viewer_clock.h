#pragma once
/// The viewer's playback clock: which moment of the performance a frame shows. Pure: it is told how much time has
/// passed.

#include "rig/result.h"

namespace blush::tool {

struct PlaybackClock {
    double from_seconds = 0, to_seconds = 0;  ///< the part that is looped; equal for a still
    double frames_a_second = 30;              ///< above 0, of single steps
    double time_seconds = 0;                  ///< from_seconds to to_seconds
    double speed = 1;                         ///< seconds of the performance a second of the viewer
    bool playing = true;

    /// Moves on by `elapsed_seconds` of the viewer's time and begins again after the end; does nothing while paused.
    /// What is negative or not finite counts as 0.
    void advance(double elapsed_seconds);
    /// Pauses and goes to a neighbouring frame (from_seconds plus a whole number of 1 / frames_a_second): the first one
    /// after the current time, or before it for negative `frames`. Stops at both ends.
    void step(int frames);
    /// Goes to a moment, limited to the part that is looped; goes on playing, or stays paused.
    void scrub(double wanted_seconds);
    /// Doubles and halves the speed, from 1/8 to 8.
    void faster();
    void slower();
};

/// A clock at `from_seconds`. A negative `to_seconds` stands for the end of the performance.
/// Error: a part that ends before it begins, or begins after the performance has ended; no frames a second.
Result<PlaybackClock> make_clock(float from_seconds, float to_seconds, float duration_seconds, double frames_a_second);

}  // namespace blush::tool
