#pragma once
/// Lua (Debian's 5.4) behind walls: no files, no programs, bounds on work and memory, the same bits in every run.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "rig/result.h"

struct lua_State;

namespace blush {

/// What a script may use. Both bounds count the same on every machine; neither is a time.
struct ScriptLimits {
    /// Instructions of Lua a step; 64 bytes of new memory count as one, too. A step of a usual script takes less than
    /// a thousand.
    std::int64_t instructions_a_step = 200'000;
    std::size_t memory_bytes = 16U << 20;
    /// No string or table part may be larger: comparing two strings is one instruction, however long they are.
    std::size_t piece_bytes = 256U << 10;
};

/// A Lua state with the safe part of the standard library:
/// - assert, error, ipairs, next, pairs, pcall, print, rawequal, rawget, rawlen, rawset, select, setmetatable (without
///   __gc, whose calls no bound can stop), getmetatable (not of strings), tonumber, tostring, type; not xpcall, whose
///   handler no bound can stop either;
/// - math but randomseed; table; string but what takes patterns (find, gmatch, gsub, match: no bound can stop a match)
///   or memory images (dump, pack, packsize, unpack).
/// pairs() and next() go in ascending order (numbers, then strings, then booleans), since Lua's own order changes from
/// run to run; so do the addresses that tostring() would show, which are left out. table.sort() is stable.
/// Exceeding a bound ends the step, whatever pcall() the script is in.
class Sandbox {
public:
    /// `seed` of math.random. `owner` is what owner_of() gives.
    Sandbox(const ScriptLimits& limits, std::uint64_t seed, void* owner);
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    /// The main thread: holds globals; scripts run in coroutines of it. Null when there was no memory for it.
    lua_State* lua() const { return lua_; }
    static void* owner_of(lua_State* lua);
    static Sandbox& of(lua_State* lua);

    /// Receives what print() writes, a line at a time.
    std::function<void(std::string_view)> print;

    /// Compiles `text` into a function, which `reference` then stands for in the registry. `file` opens every message.
    Status compile(std::string_view text, const std::string& file, int& reference);

    /// Runs `work` on the main thread where running out of memory is an error and not the end of the program.
    Status protect(const std::function<void(lua_State*)>& work);

    /// A new budget of instructions.
    void begin_step();
    /// Resumes a coroutine with `argument_count` values on its stack. true: it waits; false: it has ended.
    /// Error: "file:line: reason".
    Result<bool> resume(lua_State* coroutine, int argument_count);

    /// Takes work off the budget of the step; raises a Lua error when there is none left.
    void charge(lua_State* lua, std::int64_t instructions);

    std::int64_t instructions_used() const { return limits_.instructions_a_step - left_; }
    std::size_t memory_used() const { return used_bytes_; }
    /// The line that `lua` is at, of the script itself; 0 outside of it.
    static int line_of(lua_State* lua);

private:
    friend struct SandboxCallbacks;
    [[noreturn]] void exceed(lua_State* lua);
    Error error_of(lua_State* coroutine, int status) const;
    std::string place(int line) const;

    ScriptLimits limits_;
    void* owner_;
    lua_State* lua_ = nullptr;
    std::string file_ = "script", short_name_;
    std::int64_t left_ = 0;
    std::size_t used_bytes_ = 0;
    int exceeded_line_ = 0;
    bool exceeded_ = false, refused_piece_ = false;
};

}  // namespace blush
