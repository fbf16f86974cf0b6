#pragma once
/// Script: a Lua program that gives a face its feelings over time (docs/scripting.md).

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/motion/performance.h"
#include "rig/result.h"
#include "runtime/script/sandbox.h"

namespace blush {

struct ScriptOptions {
    std::uint64_t seed = 1;  ///< of random(): the same seed, the same bits
    ScriptLimits limits;
    /// What play("name") plays; without it, play() is an error.
    std::function<Result<Performance>(const std::string& name)> find_performance;
    /// Receives what print() writes.
    std::function<void(std::string_view line)> print;
    /// Hears of names that the rig does not have (with the line) instead of ending the script: for a checker.
    std::function<void(const std::string& name, int line)> unknown_control;
    /// Hears of every event that the script waits for, reacts to or emits: for a checker.
    std::function<void(const std::string& event)> event_used;
};

/// Where the script wants the face to look.
struct GazeWish {
    bool wished = false;                        ///< false: wherever it likes
    double yaw_radians = 0, pitch_radians = 0;  ///< signs as of Angles
    double distance_metres = 1;
};

/// Words to be seen.
struct Caption {
    std::string text;
    double from_seconds = 0, to_seconds = 0;
};

/// A script on a rig. Time passes in step(); in between nothing changes. The rig must outlive it.
///
/// Waits and motions count from the moment at which they were due and not from the step that noticed it, so that what a
/// script does depends little on how long the steps are, and not at all when they are alike.
class Script {
public:
    /// Error: the text does not compile, with file and line. Nothing of it has run yet.
    static Result<Script> create(std::string text, const std::string& file, const Rig& rig, ScriptOptions options = {});
    static Result<Script> load(const std::filesystem::path& path, const Rig& rig, ScriptOptions options = {});

    Script(Script&&) noexcept;
    Script& operator=(Script&&) noexcept;
    ~Script();

    /// Goes on by `seconds` (0 or more; the first step runs the script up to its first wait()). `below`: the controls
    /// as they would be without the script. Error: "file:line: reason", once; the script has stopped for good, and
    /// apply() goes on giving what it gave before this step.
    Status step(double seconds, std::span<const float> below);
    /// An event from outside, for the next step; it is heard as soon as its time has come.
    void emit(std::string_view event, std::string_view text, double at_seconds);

    /// Writes the controls that the script holds; the others stay as they are. No allocation, but for performances that
    /// play() began since the last step.
    void apply(std::span<float> controls);

    /// Keeps print() quiet until restart(): for a run that only finds out how long a script takes.
    void mute();

    /// Begins again, as if just created. Error: as create().
    Status restart();

    double now_seconds() const;
    /// No task waits for its time and nothing repeats: without an event nothing will happen any more, except motions
    /// coming to their ends.
    bool ended() const;
    bool stopped_by_error() const;
    /// When the last motion, caption or performance so far begun will have come to its end.
    double settled_seconds() const;
    const GazeWish& gaze() const;
    std::uint32_t blinks_wished() const;  ///< calls of blink() so far
    /// The words to be seen now; empty when there are none.
    std::string_view caption() const;
    const std::vector<Caption>& captions() const;  ///< so far, in order
    std::int64_t instructions_of_last_step() const;

    struct State;  ///< runtime/script/script_state.h

private:
    explicit Script(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace blush
