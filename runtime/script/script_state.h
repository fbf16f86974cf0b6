#pragma once
/// The inside of a Script, which the functions that Lua sees work on.

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "runtime/script/control_motion.h"
#include "runtime/script/script.h"

struct lua_State;

namespace blush {

/// A coroutine of the script.
struct ScriptTask {
    std::uint64_t id = 0;
    lua_State* thread = nullptr;
    int thread_ref = 0;      ///< keeps the coroutine from the garbage collector
    double due_seconds = 0;  ///< when it goes on; its own "now" while it runs
    bool next_step = false;  ///< not in the step that it asked in
    std::string waits_for;   ///< an event; empty: for its time alone
    int argument_count = 0;  ///< values on its stack for the next resume
    bool dead = false;
};

/// every() and on(): a function that becomes a task again and again.
struct ScriptTrigger {
    std::uint64_t id = 0;
    int function_ref = 0;
    std::string event;  ///< on(); empty for every()
    double period_seconds = 0, due_seconds = 0;
    std::uint64_t running_task = 0;  ///< every() does not begin again before the last round is over
};

struct ScriptEvent {
    std::string name, text;
    double time_seconds = 0;
};

struct PlayedPerformance {
    std::uint64_t id = 0;
    std::size_t performance = 0;  ///< index of State::performances
    double start_seconds = 0, end_seconds = 0, speed = 1, weight = 1, fade_seconds = 0;
    bool loops = false;
};

/// What is put back where a step fails.
struct ScriptMoment {
    double now_seconds = 0;
    ControlMotions motions;
    std::vector<PlayedPerformance> played;
    GazeWish gaze;
    std::uint32_t blinks = 0;
    double settled_seconds = 0;
};

struct Script::State {
    std::string text, file;
    const Rig* rig = nullptr;
    ScriptOptions options;
    std::unique_ptr<Sandbox> sandbox;

    ScriptMoment moment;
    std::vector<Caption> captions;
    std::deque<ScriptTask> tasks;  ///< does not move a task while it runs
    std::vector<ScriptTrigger> triggers;
    std::vector<ScriptEvent> events;                                     ///< still to be heard
    std::vector<std::pair<std::string, BoundPerformance>> performances;  ///< by the names that play() took
    std::uint64_t last_id = 0;
    ScriptTask* running = nullptr;
    std::span<const float> below;
    std::vector<float> scratch;
    Pose scratch_pose;
    std::vector<std::uint32_t> felt;  ///< controls that feel() and blend() have touched, ascending
    bool started = false, failed = false;
    std::int64_t last_instructions = 0;

    static State& of(lua_State* lua) { return *static_cast<State*>(Sandbox::owner_of(lua)); }
    double now() const { return running ? running->due_seconds : moment.now_seconds; }
    float value_below(std::uint32_t control) const { return control < below.size() ? below[control] : 0.0F; }

    Status compile();
    /// A new task that calls the function on top of `lua`'s stack below `argument_count` values, and takes them off.
    ScriptTask& add_task(lua_State* lua, int argument_count, double due_seconds);
    /// Starts what reacts to the event; its argument is the value on top of `lua`'s stack, which is taken off.
    void hear(lua_State* lua, const std::string& event, double at_seconds);
    Status run_until(double end_seconds);
    Status run(ScriptTask& task, double end_seconds);
    void forget(ScriptTask& task);
    void apply_played(double seconds, std::span<float> controls);
    bool idle() const;
};

/// Raises a Lua error where there are too many tasks already; `what` begins the message.
void check_room_for_task(lua_State* lua, const char* what);

/// Makes feel(), wait(), on(), ... global functions of the script.
void open_script_functions(lua_State* lua);

}  // namespace blush
