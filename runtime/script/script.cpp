#include "runtime/script/script.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

#include <lua.hpp>

#include "runtime/script/script_state.h"

namespace blush {
namespace {

/// A script that a person wrote is a few pages long.
constexpr std::uintmax_t most_text_bytes = 1U << 20;

}  // namespace

Status Script::State::compile() {
    sandbox = std::make_unique<Sandbox>(options.limits, options.seed, this);
    sandbox->print = options.print;
    int main_ref = 0;
    if (Status compiled = sandbox->compile(text, file, main_ref); !compiled) return compiled;
    return sandbox->protect([&](lua_State* lua) {
        open_script_functions(lua);
        lua_rawgeti(lua, LUA_REGISTRYINDEX, main_ref);
        add_task(lua, 0, 0);
    });
}

ScriptTask& Script::State::add_task(lua_State* lua, int argument_count, double due_seconds) {
    lua_State* const thread = lua_newthread(lua);
    const int ref = luaL_ref(lua, LUA_REGISTRYINDEX);
    lua_xmove(lua, thread, argument_count + 1);
    return tasks.emplace_back(ScriptTask{.id = ++last_id,
                                         .thread = thread,
                                         .thread_ref = ref,
                                         .due_seconds = due_seconds,
                                         .waits_for = {},
                                         .argument_count = argument_count});
}

void Script::State::forget(ScriptTask& task) {
    if (task.dead) return;
    task.dead = true;
    luaL_unref(sandbox->lua(), LUA_REGISTRYINDEX, task.thread_ref);
}

void Script::State::hear(lua_State* lua, const std::string& event, double at_seconds) {
    // Only what waits now: what an answer waits for later is another event.
    const std::size_t count = tasks.size();
    for (std::size_t i = 0; i < count; ++i) {
        ScriptTask& task = tasks[i];
        if (task.dead || task.waits_for != event || event.empty()) continue;
        lua_pushvalue(lua, -1);
        lua_xmove(lua, task.thread, 1);
        task.argument_count = 1;
        task.waits_for.clear();
        task.due_seconds = at_seconds;
    }
    for (std::size_t i = 0; i < triggers.size(); ++i) {
        if (triggers[i].event != event || event.empty()) continue;
        check_room_for_task(lua, event.c_str());
        lua_rawgeti(lua, LUA_REGISTRYINDEX, triggers[i].function_ref);
        lua_pushvalue(lua, -2);
        add_task(lua, 1, at_seconds);
    }
    lua_pop(lua, 1);
}

Status Script::State::run(ScriptTask& task, double end_seconds) {
    running = &task;
    task.next_step = false;
    const int argument_count = std::exchange(task.argument_count, 0);
    task.waits_for.clear();
    const Result<bool> waits = sandbox->resume(task.thread, argument_count);
    running = nullptr;
    if (!waits) return waits.error();
    if (!*waits) forget(task);
    if (task.next_step) task.due_seconds = end_seconds;
    return Done{};
}

Status Script::State::run_until(double end_seconds) {
    constexpr double never = std::numeric_limits<double>::infinity();
    std::ranges::stable_sort(events, {}, &ScriptEvent::time_seconds);
    // What was put off until this step may run in it.
    for (ScriptTask& task : tasks) task.next_step = false;
    while (true) {
        ScriptTask* task = nullptr;
        for (ScriptTask& candidate : tasks) {
            if (candidate.dead || candidate.next_step || candidate.due_seconds > end_seconds) continue;
            if (!task || candidate.due_seconds < task->due_seconds) task = &candidate;
        }
        ScriptTrigger* trigger = nullptr;
        for (ScriptTrigger& candidate : triggers) {
            if (!candidate.event.empty() || candidate.due_seconds > end_seconds) continue;
            if (!trigger || candidate.due_seconds < trigger->due_seconds) trigger = &candidate;
        }
        const double task_due = task ? task->due_seconds : never;
        const double trigger_due = trigger ? trigger->due_seconds : never;
        const double event_due = events.empty() ? never : events.front().time_seconds;
        if (event_due <= std::min({task_due, trigger_due, end_seconds})) {
            const ScriptEvent event = std::move(events.front());
            events.erase(events.begin());
            Status heard = sandbox->protect([&](lua_State* lua) {
                lua_pushlstring(lua, event.text.data(), event.text.size());
                hear(lua, event.name, event.time_seconds);
            });
            if (!heard) return heard;
        } else if (trigger && trigger_due <= task_due) {
            const bool busy = std::ranges::any_of(
                tasks, [&](const ScriptTask& t) { return !t.dead && t.id == trigger->running_task; });
            if (!busy) {
                Status begun = sandbox->protect([&](lua_State* lua) {
                    lua_rawgeti(lua, LUA_REGISTRYINDEX, trigger->function_ref);
                    trigger->running_task = add_task(lua, 0, trigger->due_seconds).id;
                });
                if (!begun) return begun;
            }
            trigger->due_seconds += trigger->period_seconds;
        } else if (task) {
            if (Status ran = run(*task, end_seconds); !ran) return ran;
        } else {
            break;
        }
        std::erase_if(tasks, [](const ScriptTask& t) { return t.dead; });
    }
    return Done{};
}

void Script::State::apply_played(double seconds, std::span<float> controls) {
    for (const PlayedPerformance& played : moment.played) {
        const BoundPerformance& performance = performances[played.performance].second;
        const double since = seconds - played.start_seconds, left = played.end_seconds - seconds;
        if (since < 0 || left <= 0) continue;
        const double fade_in = played.fade_seconds > 0 ? ease_at(Ease::ease_in_out, since / played.fade_seconds) : 1;
        const double fade_out = played.fade_seconds > 0 ? ease_at(Ease::ease_in_out, left / played.fade_seconds) : 1;
        const auto weight = static_cast<float>(played.weight * std::min(fade_in, fade_out));
        double moment_of_it = since * played.speed;
        const auto length = static_cast<double>(performance.duration_seconds());
        if (played.loops && length > 0) moment_of_it = std::fmod(moment_of_it, length);
        scratch.assign(controls.begin(), controls.end());
        performance.sample(static_cast<float>(moment_of_it), scratch, scratch_pose);
        for (const std::uint32_t control : performance.driven_controls()) {
            controls[control] = std::lerp(controls[control], scratch[control], weight);
        }
    }
}

bool Script::State::idle() const {
    return started && std::ranges::all_of(tasks, [](const ScriptTask& task) { return task.dead; }) && triggers.empty();
}

Result<Script> Script::create(std::string text, const std::string& file, const Rig& rig, ScriptOptions options) {
    auto state = std::make_unique<State>();
    state->text = std::move(text);
    state->file = file;
    state->rig = &rig;
    state->options = std::move(options);
    state->scratch_pose = rig.rest_pose();
    if (Status compiled = state->compile(); !compiled) return compiled.error();
    return Script(std::move(state));
}

Result<Script> Script::load(const std::filesystem::path& path, const Rig& rig, ScriptOptions options) {
    const std::string file = path.string();
    std::error_code failed;
    if (!std::filesystem::exists(path, failed)) return Error{file + ": there is no such file"};
    if (!std::filesystem::is_regular_file(path, failed)) return Error{file + ": is not a regular file"};
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    if (failed) return Error{file + ": " + failed.message()};
    if (size > most_text_bytes) {
        return Error{file + ": a script may have " + std::to_string(most_text_bytes >> 10) + " KiB, this has " +
                     std::to_string(size >> 10)};
    }
    std::ifstream stream(path, std::ios::binary);
    std::string text(size, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(size));
    if (!stream) return Error{file + ": cannot be read"};
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    return create(std::move(text), file, rig, std::move(options));
}

Script::Script(std::unique_ptr<State> state) : state_(std::move(state)) {}
Script::Script(Script&&) noexcept = default;
Script& Script::operator=(Script&&) noexcept = default;
Script::~Script() = default;

Status Script::step(double seconds, std::span<const float> below) {
    assert(seconds >= 0 && "Script::step(): time does not go back");
    State& state = *state_;
    if (state.failed) return Done{};
    const ScriptMoment before = state.moment;
    const double end_seconds = before.now_seconds + (seconds > 0 ? seconds : 0);
    state.below = below;
    state.sandbox->begin_step();
    state.started = true;
    Status ran = state.run_until(end_seconds);
    state.last_instructions = state.sandbox->instructions_used();
    state.below = {};
    if (!ran) {
        state.moment = before;
        std::erase_if(state.captions, [&](const Caption& c) { return c.from_seconds > before.now_seconds; });
        state.failed = true;
        return ran;
    }
    state.moment.now_seconds = end_seconds;
    state.moment.motions.tidy(end_seconds);
    std::erase_if(state.moment.played, [&](const PlayedPerformance& p) { return p.end_seconds <= end_seconds; });
    return Done{};
}

void Script::emit(std::string_view event, std::string_view text, double at_seconds) {
    state_->events.push_back({std::string(event), std::string(text), at_seconds});
}

void Script::apply(std::span<float> controls) {
    state_->apply_played(state_->moment.now_seconds, controls);
    state_->moment.motions.apply(state_->moment.now_seconds, controls);
}

Status Script::restart() {
    auto fresh = std::make_unique<State>();
    fresh->text = std::move(state_->text);
    fresh->file = std::move(state_->file);
    fresh->rig = state_->rig;
    fresh->options = std::move(state_->options);
    fresh->performances = std::move(state_->performances);
    fresh->scratch_pose = std::move(state_->scratch_pose);
    state_ = std::move(fresh);
    return state_->compile();
}

double Script::now_seconds() const { return state_->moment.now_seconds; }
bool Script::ended() const { return state_->failed || state_->idle(); }
bool Script::stopped_by_error() const { return state_->failed; }
double Script::settled_seconds() const { return state_->moment.settled_seconds; }
const GazeWish& Script::gaze() const { return state_->moment.gaze; }
std::uint32_t Script::blinks_wished() const { return state_->moment.blinks; }
const std::vector<Caption>& Script::captions() const { return state_->captions; }
std::int64_t Script::instructions_of_last_step() const { return state_->last_instructions; }

std::string_view Script::caption() const {
    const double now = state_->moment.now_seconds;
    // The last one that has begun: who speaks again has finished.
    const auto last = std::ranges::find_if(state_->captions.rbegin(), state_->captions.rend(),
                                           [&](const Caption& c) { return c.from_seconds <= now; });
    return last != state_->captions.rend() && now < last->to_seconds ? std::string_view(last->text) : "";
}

}  // namespace blush
