#pragma once
/// The parts of Lua's library that the sandbox replaces.

struct lua_State;

namespace blush {

/// Opens the safe part of the standard library in a new state.
void open_safe_library(lua_State* lua, unsigned long long seed);

}  // namespace blush
