/// The functions that a script sees: feel, blend, set, get, release, wait, ... (docs/scripting.md).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include <lua.hpp>

#include "rig/names.h"
#include "runtime/script/script_state.h"

namespace blush {
namespace {

/// More than a script that a person reads can mean, and few enough that the scheduler's walk through them is cheap.
constexpr std::size_t most_tasks = 256, most_triggers = 256, most_played = 16, most_captions = 1000;
/// An expression appears within about half a second (Ekman and Friesen 1982 on onset times; from memory).
constexpr double usual_over_seconds = 0.5;
constexpr double most_seconds = 1e6;  // eleven days: a slip of the finger

using State = Script::State;

[[noreturn]] void raise(lua_State* lua, const std::string& message) {
    luaL_where(lua, 1);
    lua_pushlstring(lua, message.data(), message.size());
    lua_concat(lua, 2);
    lua_error(lua);
    std::abort();  // not reached: lua_error does not return
}

std::string string_at(lua_State* lua, int index, const char* function, const char* what) {
    if (lua_type(lua, index) != LUA_TSTRING) {
        raise(lua, std::string(function) + ": " + what + " must be a string, not " + luaL_typename(lua, index));
    }
    std::size_t length = 0;
    const char* const text = lua_tolstring(lua, index, &length);
    return {text, length};
}

double number_at(lua_State* lua, int index, const char* function, const char* what) {
    if (lua_type(lua, index) != LUA_TNUMBER) {
        raise(lua, std::string(function) + ": " + what + " must be a number, not " + luaL_typename(lua, index));
    }
    const double number = lua_tonumber(lua, index);
    if (!std::isfinite(number)) raise(lua, std::string(function) + ": " + what + " is not finite");
    return number;
}

double seconds_at(lua_State* lua, int index, const char* function, const char* what) {
    const double seconds = number_at(lua, index, function, what);
    if (seconds < 0 || seconds > most_seconds) {
        raise(lua, std::string(function) + ": " + what + " must be 0 to 1000000 seconds");
    }
    return seconds;
}

/// What the table of options at the end of a call may say. A misspelt one is an error and not a default.
class CallOptions {
public:
    CallOptions(lua_State* lua, int index, const char* function, std::initializer_list<const char*> known)
        : lua_(lua), index_(index), function_(function) {
        if (lua_isnoneornil(lua, index)) return;
        if (!lua_istable(lua, index)) {
            raise(lua, std::string(function) + ": options are a table, like {over = 1.5}, not a " +
                           luaL_typename(lua, index));
        }
        lua_pushnil(lua);
        while (lua_next(lua, index) != 0) {
            lua_pop(lua, 1);
            const std::string name = lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : luaL_typename(lua, -1);
            if (std::ranges::any_of(known, [&](const char* k) { return name == k; })) continue;
            std::string names;
            for (const char* k : known) names += std::string(names.empty() ? "" : ", ") + k;
            raise(lua, std::string(function) + ": there is no option '" + name + "' (there are: " + names + ")");
        }
        present_ = true;
    }

    double seconds(const char* name, double otherwise) const {
        if (!push(name)) return otherwise;
        const double seconds = seconds_at(lua_, -1, function_, name);
        lua_pop(lua_, 1);
        return seconds;
    }
    double number(const char* name, double otherwise) const {
        if (!push(name)) return otherwise;
        const double number = number_at(lua_, -1, function_, name);
        lua_pop(lua_, 1);
        return number;
    }
    bool flag(const char* name) const {
        if (!push(name)) return false;
        const bool set = lua_toboolean(lua_, -1) != 0;
        lua_pop(lua_, 1);
        return set;
    }
    Ease ease() const {
        if (!push("ease")) return Ease::ease_in_out;
        const std::string name = string_at(lua_, -1, function_, "ease");
        lua_pop(lua_, 1);
        const std::optional<Ease> found = find_ease(name);
        if (!found) {
            raise(lua_, std::string(function_) + ": ease '" + name +
                            "' is none of smooth, linear, step, ease-in, ease-out, ease-in-out");
        }
        return *found;
    }

private:
    bool push(const char* name) const {
        if (!present_) return false;
        lua_pushstring(lua_, name);
        if (lua_rawget(lua_, index_) != LUA_TNIL) return true;
        lua_pop(lua_, 1);
        return false;
    }
    lua_State* lua_;
    int index_;
    const char* function_;
    bool present_ = false;
};

/// Nothing where a checker has taken note of a name that does not exist.
std::optional<std::uint32_t> control_at(lua_State* lua, int index, const char* function) {
    const std::string name = string_at(lua, index, function, "the name of a control");
    const State& state = State::of(lua);
    if (const std::optional<ControlId> control = state.rig->find(name)) return static_cast<std::uint32_t>(*control);
    if (state.options.unknown_control) {
        state.options.unknown_control(name, Sandbox::line_of(lua));
        return std::nullopt;
    }
    const std::optional<std::string> near = nearest_name(name, state.rig->control_names());
    raise(lua, std::string(function) + ": the face has no control '" + name + "'" +
                   (near ? " (did you mean '" + *near + "'?)" : ""));
}

void settle(State& state, double seconds) {
    state.moment.settled_seconds = std::max(state.moment.settled_seconds, seconds);
}

void move(State& state, std::uint32_t control, double value, double over_seconds, Ease ease) {
    // Adding a number beyond a float's range to a rig would be an infinity by the time it gets there.
    constexpr double limit = static_cast<double>(largest_weight);
    state.moment.motions.move(control, std::clamp(value, -limit, limit), state.now(), over_seconds, ease,
                              static_cast<double>(state.value_below(control)));
    settle(state, state.now() + over_seconds);
}

void remember_felt(State& state, std::uint32_t control) {
    const auto place = std::ranges::lower_bound(state.felt, control);
    if (place == state.felt.end() || *place != control) state.felt.insert(place, control);
}

/// The mixture of a table {joy = 0.3, ...}, ascending by control. Two spellings of one control are an error, since
/// which of them came last would be chance.
std::vector<std::pair<std::uint32_t, double>> mixture_at(lua_State* lua, int index, const char* function) {
    std::vector<std::pair<std::uint32_t, double>> mixture;
    lua_pushnil(lua);
    while (lua_next(lua, index) != 0) {
        const double value = number_at(lua, -1, function, "the value of a control");
        const std::optional<std::uint32_t> control = control_at(lua, -2, function);
        if (control) mixture.emplace_back(*control, value);
        lua_pop(lua, 1);
    }
    std::ranges::sort(mixture);
    const auto twice = std::ranges::adjacent_find(mixture, {}, &std::pair<std::uint32_t, double>::first);
    if (twice != mixture.end()) {
        raise(lua, std::string(function) + ": two of the names mean '" +
                       State::of(lua).rig->control_names()[twice->first] + "'");
    }
    return mixture;
}

/// feel("joy", 0.8, {over = 1.5}) or feel({joy = 0.3, sadness = 0.5}, {over = 1.5}); gives the seconds that it takes.
int feel(lua_State* lua) {
    State& state = State::of(lua);
    const bool several = lua_istable(lua, 1);
    const CallOptions options(lua, several ? 2 : 3, "feel", {"over", "ease"});
    const double over = options.seconds("over", usual_over_seconds);
    const Ease ease = options.ease();
    if (several) {
        for (const auto& [control, value] : mixture_at(lua, 1, "feel")) {
            move(state, control, value, over, ease);
            remember_felt(state, control);
        }
    } else {
        const std::optional<std::uint32_t> control = control_at(lua, 1, "feel");
        const double value = number_at(lua, 2, "feel", "the value of a control");
        if (control) {
            move(state, *control, value, over, ease);
            remember_felt(state, *control);
        }
    }
    lua_pushnumber(lua, over);
    return 1;
}

/// blend({anger = 0.7}, {over = 2}): as feel(), and everything else that feel() or blend() has touched goes to 0.
int blend(lua_State* lua) {
    State& state = State::of(lua);
    if (!lua_istable(lua, 1)) raise(lua, "blend: takes a table, like blend({joy = 0.3, sadness = 0.5}, {over = 2})");
    const CallOptions options(lua, 2, "blend", {"over", "ease"});
    const double over = options.seconds("over", usual_over_seconds);
    const Ease ease = options.ease();
    const auto mixture = mixture_at(lua, 1, "blend");
    for (const std::uint32_t control : state.felt) {
        if (!std::ranges::binary_search(mixture, control, {}, &std::pair<std::uint32_t, double>::first)) {
            move(state, control, 0, over, ease);
        }
    }
    for (const auto& [control, value] : mixture) {
        move(state, control, value, over, ease);
        remember_felt(state, control);
    }
    lua_pushnumber(lua, over);
    return 1;
}

int set(lua_State* lua) {
    const std::optional<std::uint32_t> control = control_at(lua, 1, "set");
    const double value = number_at(lua, 2, "set", "the value of a control");
    if (control) move(State::of(lua), *control, value, 0, Ease::step);
    return 0;
}

int get(lua_State* lua) {
    const State& state = State::of(lua);
    const std::optional<std::uint32_t> control = control_at(lua, 1, "get");
    lua_pushnumber(lua, control ? state.moment.motions.value(*control, state.now(),
                                                             static_cast<double>(state.value_below(*control)))
                                : 0);
    return 1;
}

int has(lua_State* lua) {
    lua_pushboolean(lua, State::of(lua).rig->find(string_at(lua, 1, "has", "the name of a control")).has_value());
    return 1;
}

/// release("headYaw", {over = 1}): gives a control back to what lies below the script.
int release(lua_State* lua) {
    State& state = State::of(lua);
    const std::optional<std::uint32_t> control = control_at(lua, 1, "release");
    const double over = CallOptions(lua, 2, "release", {"over"}).seconds("over", usual_over_seconds);
    if (control) state.moment.motions.release(*control, state.now(), over);
    settle(state, state.now() + over);
    lua_pushnumber(lua, over);
    return 1;
}

int now(lua_State* lua) {
    lua_pushnumber(lua, State::of(lua).now());
    return 1;
}

void check_may_wait(lua_State* lua, const char* function) {
    if (!lua_isyieldable(lua)) {
        raise(lua, std::string(function) + ": cannot wait inside of a sort's or a metatable's function");
    }
}

int wait(lua_State* lua) {
    ScriptTask& task = *State::of(lua).running;
    const double seconds = lua_isnoneornil(lua, 1) ? 0 : number_at(lua, 1, "wait", "the time");
    if (seconds > most_seconds) raise(lua, "wait: the time must be 0 to 1000000 seconds");
    check_may_wait(lua, "wait");
    // No time at all would never let the step end, and a sum can be too small to change the clock.
    const double due = task.due_seconds + seconds;
    task.next_step = !(due > task.due_seconds);
    task.due_seconds = std::max(due, task.due_seconds);
    return lua_yield(lua, 0);
}

int wait_for(lua_State* lua) {
    State& state = State::of(lua);
    ScriptTask& task = *state.running;
    const std::string event = string_at(lua, 1, "wait_for", "the name of an event");
    if (event.empty()) raise(lua, "wait_for: the name of an event is empty");
    const double patience =
        lua_isnoneornil(lua, 2) ? std::numeric_limits<double>::infinity() : seconds_at(lua, 2, "wait_for", "the time");
    check_may_wait(lua, "wait_for");
    if (state.options.event_used) state.options.event_used(event);
    task.waits_for = event;
    task.next_step = patience <= 0;
    task.due_seconds += patience;
    return lua_yield(lua, 0);
}

void check_function(lua_State* lua, int index, const char* function) {
    if (!lua_isfunction(lua, index)) {
        raise(lua, std::string(function) + ": a function is needed, not a " + luaL_typename(lua, index));
    }
}

void add_trigger(lua_State* lua, ScriptTrigger trigger, const char* function) {
    State& state = State::of(lua);
    if (state.triggers.size() >= most_triggers) {
        raise(lua, std::string(function) + ": more than " + std::to_string(most_triggers) + " of on() and every()");
    }
    trigger.id = ++state.last_id;
    lua_pushvalue(lua, 2);
    trigger.function_ref = luaL_ref(lua, LUA_REGISTRYINDEX);
    lua_pushinteger(lua, static_cast<lua_Integer>(trigger.id));
    state.triggers.push_back(std::move(trigger));
}

/// on("poke", function(text) ... end): the function begins, as a task, whenever the event comes. Gives a handle.
int on(lua_State* lua) {
    const std::string event = string_at(lua, 1, "on", "the name of an event");
    if (event.empty()) raise(lua, "on: the name of an event is empty");
    check_function(lua, 2, "on");
    if (const auto& used = State::of(lua).options.event_used) used(event);
    add_trigger(lua, {.event = event}, "on");
    return 1;
}

/// every(3, function() ... end): the function begins now and then every 3 seconds, unless it is still at it.
int every(lua_State* lua) {
    const double period = seconds_at(lua, 1, "every", "the time");
    // A millisecond is far below a frame; much less would be a loop without end within one step.
    if (period < 1e-3) raise(lua, "every: the time must be 0.001 seconds at least");
    check_function(lua, 2, "every");
    add_trigger(lua, {.event = {}, .period_seconds = period, .due_seconds = State::of(lua).now()}, "every");
    return 1;
}

/// start(function, ...): a task of its own, which goes on beside this one. Gives a handle.
int start(lua_State* lua) {
    check_function(lua, 1, "start");
    check_room_for_task(lua, "start");
    State& state = State::of(lua);
    const ScriptTask& task = state.add_task(lua, lua_gettop(lua) - 1, state.now());
    lua_pushinteger(lua, static_cast<lua_Integer>(task.id));
    return 1;
}

/// stop(handle) of start(), on(), every(), play(). Of what is over already, nothing happens.
int stop(lua_State* lua) {
    State& state = State::of(lua);
    const auto id = static_cast<std::uint64_t>(number_at(lua, 1, "stop", "a handle"));
    if (state.running->id == id) raise(lua, "stop: a task ends itself by return");
    for (ScriptTask& task : state.tasks) {
        if (task.id == id) state.forget(task);
    }
    const auto trigger = std::ranges::find(state.triggers, id, &ScriptTrigger::id);
    if (trigger != state.triggers.end()) {
        luaL_unref(lua, LUA_REGISTRYINDEX, trigger->function_ref);
        state.triggers.erase(trigger);
    }
    for (PlayedPerformance& played : state.moment.played) {
        if (played.id == id) played.end_seconds = std::min(played.end_seconds, state.now() + played.fade_seconds);
    }
    return 0;
}

/// emit("poke", value): an event that other tasks hear at once.
int emit(lua_State* lua) {
    State& state = State::of(lua);
    const std::string event = string_at(lua, 1, "emit", "the name of an event");
    check_room_for_task(lua, "emit");
    if (state.options.event_used) state.options.event_used(event);
    lua_settop(lua, 2);
    state.hear(lua, event, state.now());
    return 0;
}

int play(lua_State* lua) {
    State& state = State::of(lua);
    const std::string name = string_at(lua, 1, "play", "the name of a performance");
    const CallOptions options(lua, 2, "play", {"weight", "speed", "fade", "loop"});
    PlayedPerformance played{.weight = options.number("weight", 1),
                             .fade_seconds = options.seconds("fade", 0.2),
                             .loops = options.flag("loop")};
    played.speed = options.number("speed", 1);
    if (!(played.speed >= 0.01 && played.speed <= 100)) raise(lua, "play: speed must be 0.01 to 100");
    if (!(played.weight >= 0 && played.weight <= 1)) raise(lua, "play: weight must be 0 to 1");
    if (state.moment.played.size() >= most_played) {
        raise(lua, "play: more than " + std::to_string(most_played) + " performances at once");
    }
    auto known = std::ranges::find(state.performances, name, &std::pair<std::string, BoundPerformance>::first);
    if (known == state.performances.end()) {
        if (!state.options.find_performance) raise(lua, "play: there are no performances to play here");
        // Reading a file is dear, whatever it holds.
        Sandbox::of(lua).charge(lua, state.options.limits.instructions_a_step / 16);
        Result<Performance> found = state.options.find_performance(name);
        if (!found) raise(lua, "play: " + found.error().message);
        state.performances.emplace_back(name, BoundPerformance(*std::move(found), *state.rig));
        known = state.performances.end() - 1;
    }
    played.performance = static_cast<std::size_t>(known - state.performances.begin());
    played.id = ++state.last_id;
    played.start_seconds = state.now();
    const double length = static_cast<double>(known->second.duration_seconds()) / played.speed;
    played.end_seconds = played.loops ? std::numeric_limits<double>::infinity() : state.now() + length;
    settle(state, state.now() + length);
    state.moment.played.push_back(played);
    lua_pushnumber(lua, length);
    lua_pushinteger(lua, static_cast<lua_Integer>(played.id));
    return 2;
}

/// look(20, -5): degrees to the face's own left, and down; look() leaves it to the face again.
int look(lua_State* lua) {
    GazeWish& gaze = State::of(lua).moment.gaze;
    if (lua_isnoneornil(lua, 1)) {
        gaze = {};
        return 0;
    }
    const double yaw = number_at(lua, 1, "look", "the angle to the side");
    const double pitch = lua_isnoneornil(lua, 2) ? 0 : number_at(lua, 2, "look", "the angle down");
    const CallOptions options(lua, 3, "look", {"distance"});
    gaze.distance_metres = options.number("distance", GazeWish{}.distance_metres);
    if (!(gaze.distance_metres >= 0.05)) raise(lua, "look: distance must be 0.05 metres at least");
    if (!(std::abs(yaw) <= 90 && std::abs(pitch) <= 90)) raise(lua, "look: angles must be -90 to 90 degrees");
    constexpr double radians_a_degree = 3.14159265358979323846 / 180;
    gaze.wished = true;
    gaze.yaw_radians = yaw * radians_a_degree;
    gaze.pitch_radians = pitch * radians_a_degree;
    return 0;
}

int blink(lua_State* lua) {
    ++State::of(lua).moment.blinks;
    return 0;
}

/// say("Oh.", {over = 2}): words to be seen; gives the seconds for which they stand.
int say(lua_State* lua) {
    State& state = State::of(lua);
    const std::string text = string_at(lua, 1, "say", "the text");
    const CallOptions options(lua, 2, "say", {"over"});
    const double over = options.seconds("over", reading_seconds(text));
    if (state.captions.size() >= most_captions) state.captions.erase(state.captions.begin());
    state.captions.push_back({text, state.now(), state.now() + over});
    settle(state, state.now() + over);
    lua_pushnumber(lua, over);
    return 1;
}

}  // namespace

void check_room_for_task(lua_State* lua, const char* function) {
    if (State::of(lua).tasks.size() >= most_tasks) {
        raise(lua, std::string(function) + ": more than " + std::to_string(most_tasks) + " tasks at once");
    }
}

void open_script_functions(lua_State* lua) {
    constexpr std::array<std::pair<const char*, lua_CFunction>, 18> functions = {{
        {"feel", feel},
        {"blend", blend},
        {"set", set},
        {"get", get},
        {"has", has},
        {"release", release},
        {"now", now},
        {"wait", wait},
        {"wait_for", wait_for},
        {"on", on},
        {"every", every},
        {"start", start},
        {"stop", stop},
        {"emit", emit},
        {"play", play},
        {"look", look},
        {"blink", blink},
        {"say", say},
    }};
    for (const auto& [name, function] : functions) lua_register(lua, name, function);
    lua_getglobal(lua, "math");
    lua_getfield(lua, -1, "random");
    lua_setglobal(lua, "random");
    lua_pop(lua, 1);
}

}  // namespace blush
