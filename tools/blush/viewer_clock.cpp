#include "tools/blush/viewer_clock.h"

#include <algorithm>
#include <cmath>

namespace blush::tool {
namespace {

// Beyond these a performance stands still or is a blur.
constexpr double slowest = 1.0 / 8, fastest = 8;

// A time this near to a frame, in frames, is that frame: times of frames are sums of rounded numbers.
constexpr double same_frame = 1e-6;

}  // namespace

void PlaybackClock::advance(double elapsed_seconds) {
    if (!playing || !std::isfinite(elapsed_seconds) || elapsed_seconds <= 0) return;
    const double length = to_seconds - from_seconds;
    if (length <= 0) return;
    time_seconds = from_seconds + std::fmod(time_seconds - from_seconds + elapsed_seconds * speed, length);
}

void PlaybackClock::step(int frames) {
    playing = false;
    const double frame = (time_seconds - from_seconds) * frames_a_second;
    const double whole = frames < 0 ? std::ceil(frame - same_frame) : std::floor(frame + same_frame);
    scrub(from_seconds + (whole + frames) / frames_a_second);
}

void PlaybackClock::scrub(double wanted_seconds) {
    if (std::isfinite(wanted_seconds)) time_seconds = std::clamp(wanted_seconds, from_seconds, to_seconds);
}

void PlaybackClock::faster() { speed = std::min(speed * 2, fastest); }
void PlaybackClock::slower() { speed = std::max(speed / 2, slowest); }

Result<PlaybackClock> make_clock(float from_seconds, float to_seconds, float duration_seconds, double frames_a_second) {
    const float end_seconds = to_seconds < 0 ? duration_seconds : to_seconds;
    const bool in_order = from_seconds <= end_seconds && from_seconds <= duration_seconds;
    if (!in_order || !std::isfinite(end_seconds)) {
        return Error{"--from " + std::to_string(from_seconds) + " --to " + std::to_string(end_seconds) +
                     ": not a part of a performance of " + std::to_string(duration_seconds) + " seconds"};
    }
    if (!(frames_a_second > 0)) return Error{"--fps " + std::to_string(frames_a_second) + ": not a number above 0"};
    PlaybackClock clock;
    clock.from_seconds = clock.time_seconds = static_cast<double>(from_seconds);
    clock.to_seconds = static_cast<double>(end_seconds);
    clock.frames_a_second = frames_a_second;
    return clock;
}

}  // namespace blush::tool
