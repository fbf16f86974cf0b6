#include "runtime/script/sandbox.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <lua.hpp>

#include "runtime/script/sandbox_library.h"

namespace blush {
namespace {

/// Instructions between two looks at the budget.
constexpr int hook_interval = 100;
/// Bytes of new memory that count as an instruction: writing and collecting them takes about as long.
constexpr std::size_t bytes_an_instruction = 64;
/// What a refused request costs: Lua collects all garbage before it gives up.
constexpr std::int64_t refusal_cost = 20'000;

/// Comes back from a bound as a plain value, so that no message has to be built when there is no memory left for one.
constexpr const char* bound_message = "a bound was exceeded";

}  // namespace

struct SandboxCallbacks {
    static void* allocate(void* user, void* old, std::size_t old_bytes, std::size_t new_bytes) {
        Sandbox& self = *static_cast<Sandbox*>(user);
        const std::size_t had = old ? old_bytes : 0;  // for a new block Lua tells its kind here
        if (new_bytes == 0) {
            std::free(old);
            self.used_bytes_ -= had;
            return nullptr;
        }
        if (new_bytes > had) {
            const std::size_t growth = new_bytes - had;
            const bool too_large = new_bytes > self.limits_.piece_bytes;
            if (too_large || growth > self.limits_.memory_bytes - self.used_bytes_) {
                self.refused_piece_ = too_large;
                self.left_ -= refusal_cost;
                return nullptr;
            }
            self.left_ -= static_cast<std::int64_t>(growth / bytes_an_instruction);
        }
        void* block = std::realloc(old, new_bytes);
        if (block) self.used_bytes_ += new_bytes - had;
        return block;
    }

    static void count(lua_State* lua, lua_Debug* /*unused*/) { Sandbox::of(lua).charge(lua, hook_interval); }
    static void count_each(lua_State* lua, lua_Debug* /*unused*/) { Sandbox::of(lua).charge(lua, 1); }

    static int call(lua_State* lua) {
        (*static_cast<const std::function<void(lua_State*)>*>(lua_touserdata(lua, 1)))(lua);
        return 0;
    }

    static int open(lua_State* lua) {
        open_safe_library(lua, static_cast<unsigned long long>(lua_tointeger(lua, 1)));
        return 0;
    }
};

Sandbox::Sandbox(const ScriptLimits& limits, std::uint64_t seed, void* owner) : limits_(limits), owner_(owner) {
    begin_step();
    lua_ = lua_newstate(SandboxCallbacks::allocate, this);
    if (!lua_) return;
    *static_cast<Sandbox**>(lua_getextraspace(lua_)) = this;  // every coroutine gets a copy
    lua_pushcfunction(lua_, SandboxCallbacks::open);
    lua_pushinteger(lua_, static_cast<lua_Integer>(seed));
    if (lua_pcall(lua_, 1, 0, 0) != LUA_OK) {
        lua_close(lua_);
        lua_ = nullptr;
    }
}

Sandbox::~Sandbox() {
    if (lua_) lua_close(lua_);
}

Sandbox& Sandbox::of(lua_State* lua) { return **static_cast<Sandbox**>(lua_getextraspace(lua)); }
void* Sandbox::owner_of(lua_State* lua) { return of(lua).owner_; }

void Sandbox::begin_step() {
    left_ = limits_.instructions_a_step;
    exceeded_ = false;
    refused_piece_ = false;
}

void Sandbox::charge(lua_State* lua, std::int64_t instructions) {
    // The limit first: subtracting a huge charge again and again must not wrap around.
    left_ -= std::min(instructions, limits_.instructions_a_step + 1);
    if (left_ < 0) exceed(lua);
}

void Sandbox::exceed(lua_State* lua) {
    if (!exceeded_) exceeded_line_ = line_of(lua);
    exceeded_ = true;
    // A pcall() may catch this error; but then the next instruction outside of it raises it again, and so on outwards.
    lua_sethook(lua, SandboxCallbacks::count_each, LUA_MASKCOUNT, 1);
    lua_pushstring(lua, bound_message);
    lua_error(lua);
    std::abort();  // not reached: lua_error does not return
}

int Sandbox::line_of(lua_State* lua) {
    lua_Debug at;
    for (int level = 0; lua_getstack(lua, level, &at) != 0; ++level) {
        lua_getinfo(lua, "Sl", &at);
        if (at.currentline > 0) return at.currentline;
    }
    return 0;
}

std::string Sandbox::place(int line) const { return file_ + (line > 0 ? ":" + std::to_string(line) : "") + ": "; }

Status Sandbox::compile(std::string_view text, const std::string& file, int& reference) {
    if (!lua_) return Error{file + ": there is no memory for a script"};
    file_ = file;
    short_name_ = std::filesystem::path(file).filename().string();
    begin_step();
    const std::string chunk_name = "=" + short_name_;
    return protect([&](lua_State* lua) {
        // "t": text only. A crafted binary chunk could reach outside of the virtual machine.
        if (luaL_loadbufferx(lua, text.data(), text.size(), chunk_name.c_str(), "t") != LUA_OK) lua_error(lua);
        reference = luaL_ref(lua, LUA_REGISTRYINDEX);
    });
}

Status Sandbox::protect(const std::function<void(lua_State*)>& work) {
    lua_pushcfunction(lua_, SandboxCallbacks::call);
    lua_pushlightuserdata(lua_, const_cast<std::function<void(lua_State*)>*>(&work));
    const int status = lua_pcall(lua_, 1, 0, 0);
    if (status == LUA_OK) return Done{};
    Error error = error_of(lua_, status);
    lua_pop(lua_, 1);
    return error;
}

Result<bool> Sandbox::resume(lua_State* coroutine, int argument_count) {
    lua_sethook(coroutine, SandboxCallbacks::count, LUA_MASKCOUNT, hook_interval);
    // A coroutine's first instructions, before the hook fires, are paid for here.
    left_ -= hook_interval;
    int result_count = 0;
    const int status = lua_resume(coroutine, lua_, argument_count, &result_count);
    if (left_ < 0) {
        return Error{place(exceeded_ ? exceeded_line_ : line_of(coroutine)) +
                     "the script did not come to a wait() or its end within " +
                     std::to_string(limits_.instructions_a_step) + " instructions of one step"};
    }
    if (status == LUA_YIELD) {
        lua_pop(coroutine, result_count);
        return true;
    }
    if (status == LUA_OK) return false;
    return error_of(coroutine, status);
}

Error Sandbox::error_of(lua_State* coroutine, int status) const {
    if (status == LUA_ERRMEM) {
        lua_Debug deep;
        constexpr int deep_level = 1000;  // where memory ends in the middle of that many calls, they are what took it
        if (lua_getstack(coroutine, deep_level, &deep) != 0) {
            return Error{place(line_of(coroutine)) + "calls are nested too deep; a function calls itself without end"};
        }
        return Error{
            place(line_of(coroutine)) +
            (refused_piece_
                 ? "a string or table of more than " + std::to_string(limits_.piece_bytes >> 10) + " KiB is asked for"
                 : "the script needs more than " + std::to_string(limits_.memory_bytes >> 20) + " MiB of memory")};
    }
    if (lua_type(coroutine, -1) != LUA_TSTRING) {
        return Error{place(line_of(coroutine)) + "error() was called with a " + luaL_typename(coroutine, -1)};
    }
    std::size_t length = 0;
    const char* const text = lua_tolstring(coroutine, -1, &length);
    constexpr std::size_t longest = 400;  // one sentence, whatever the script put into it
    std::string message(text, std::min(length, longest));
    for (char& c : message) c = c == '\n' ? ' ' : c;
    // Lua shortens long names of chunks, but a user should see which file it is.
    if (message.starts_with(short_name_ + ":")) return Error{file_ + message.substr(short_name_.size())};
    return Error{place(line_of(coroutine)) + message};
}

}  // namespace blush
