#include "runtime/script/sandbox_library.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include <lua.hpp>

#include "runtime/script/sandbox.h"

namespace blush {
namespace {

void charge(lua_State* lua, std::int64_t instructions) { Sandbox::of(lua).charge(lua, instructions); }

// --- base ---

/// A key of a table in an order that is the same in every run: whole numbers, other numbers, strings, booleans.
struct Key {
    int rank = 0;
    lua_Integer whole = 0;
    lua_Number number = 0;
    std::string_view text;
    std::partial_ordering operator<=>(const Key&) const = default;
};

Key key_at(lua_State* lua, int index, const char* function) {
    switch (lua_type(lua, index)) {
        case LUA_TNUMBER:
            if (lua_isinteger(lua, index)) return {.rank = 0, .whole = lua_tointeger(lua, index), .text = {}};
            return {.rank = 1, .number = lua_tonumber(lua, index), .text = {}};
        case LUA_TSTRING: {
            std::size_t length = 0;
            const char* const text = lua_tolstring(lua, index, &length);
            return {.rank = 2, .text = {text, length}};
        }
        case LUA_TBOOLEAN:
            return {.rank = 3, .whole = lua_toboolean(lua, index), .text = {}};
        default:
            luaL_error(lua, "%s: a key is a %s; only numbers, strings and booleans have the same order in every run",
                       function, luaL_typename(lua, index));
            return {};
    }
}

void push_key(lua_State* lua, const Key& key) {
    if (key.rank == 0) lua_pushinteger(lua, key.whole);
    if (key.rank == 1) lua_pushnumber(lua, key.number);
    if (key.rank == 2) lua_pushlstring(lua, key.text.data(), key.text.size());
    if (key.rank == 3) lua_pushboolean(lua, key.whole != 0);
}

/// Upvalues: the table, its keys in order, the number of the next one.
int next_pair(lua_State* lua) {
    lua_Integer at = lua_tointeger(lua, lua_upvalueindex(3));
    while (lua_rawgeti(lua, lua_upvalueindex(2), ++at) != LUA_TNIL) {
        lua_pushvalue(lua, -1);
        lua_rawget(lua, lua_upvalueindex(1));
        if (!lua_isnil(lua, -1)) {
            lua_pushinteger(lua, at);
            lua_replace(lua, lua_upvalueindex(3));
            return 2;
        }
        lua_pop(lua, 2);  // taken out of the table while it was walked through
        charge(lua, 1);
    }
    return 1;
}

int pairs(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    std::vector<Key> keys;
    lua_pushnil(lua);
    while (lua_next(lua, 1) != 0) {
        lua_pop(lua, 1);
        keys.push_back(key_at(lua, -1, "pairs"));
    }
    // A sort compares each key some log2(n) times; 16 bits are more than a table may have.
    charge(lua, 16 * static_cast<std::int64_t>(keys.size()));
    std::ranges::sort(keys, [](const Key& a, const Key& b) { return a < b; });
    lua_pushvalue(lua, 1);
    lua_createtable(lua, static_cast<int>(keys.size()), 0);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        push_key(lua, keys[i]);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(i + 1));
    }
    lua_pushinteger(lua, 0);
    lua_pushcclosure(lua, next_pair, 3);
    return 1;
}

int next(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    lua_settop(lua, 2);
    const bool from_start = lua_isnil(lua, 2);
    const Key after = from_start ? Key{} : key_at(lua, 2, "next");
    bool found = false;
    Key best;
    lua_pushnil(lua);
    std::int64_t count = 0;
    while (lua_next(lua, 1) != 0) {
        lua_pop(lua, 1);
        const Key key = key_at(lua, -1, "next");
        if ((from_start || key > after) && (!found || key < best)) best = key;
        found = found || from_start || key > after;
        ++count;
    }
    charge(lua, count);
    if (!found) {
        lua_pushnil(lua);
        return 1;
    }
    push_key(lua, best);
    lua_pushvalue(lua, -1);
    lua_rawget(lua, 1);
    return 2;
}

/// Pushes the text of a value: without the address that Lua shows of tables and functions.
void push_text(lua_State* lua, int index) {
    index = lua_absindex(lua, index);
    const int type = lua_type(lua, index);
    const bool has_address =
        type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TTHREAD || type == LUA_TUSERDATA;
    if (has_address) {
        if (luaL_getmetafield(lua, index, "__tostring") == LUA_TNIL) {
            lua_pushstring(lua, lua_typename(lua, type));
            return;
        }
        lua_pop(lua, 1);
    }
    luaL_tolstring(lua, index, nullptr);
}

int to_string(lua_State* lua) {
    luaL_checkany(lua, 1);
    push_text(lua, 1);
    return 1;
}

int to_number(lua_State* lua) {
    charge(lua, static_cast<std::int64_t>(lua_type(lua, 1) == LUA_TSTRING ? lua_rawlen(lua, 1) : 0));
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, lua_gettop(lua) - 1, 1);
    return 1;
}

int print(lua_State* lua) {
    luaL_Buffer line;
    const int count = lua_gettop(lua);
    luaL_buffinit(lua, &line);
    for (int i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&line, '\t');
        push_text(lua, i);
        luaL_addvalue(&line);
    }
    luaL_pushresult(&line);
    constexpr std::int64_t cost = 100;  // at most some thousand lines a step
    charge(lua, cost);
    std::size_t length = 0;
    const char* const text = lua_tolstring(lua, -1, &length);
    if (const auto& write = Sandbox::of(lua).print) write({text, length});
    return 0;
}

int set_metatable(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    luaL_argexpected(lua, lua_isnil(lua, 2) || lua_istable(lua, 2), 2, "nil or table");
    if (luaL_getmetafield(lua, 1, "__metatable") != LUA_TNIL)
        return luaL_error(lua, "cannot change a protected metatable");
    if (lua_istable(lua, 2)) {
        lua_pushstring(lua, "__gc");
        // Collectors run where no hook is called: a loop in one would never end.
        if (lua_rawget(lua, 2) != LUA_TNIL) return luaL_error(lua, "setmetatable: '__gc' is not allowed in scripts");
    }
    lua_settop(lua, 2);
    lua_setmetatable(lua, 1);
    return 1;
}

// --- table: plain ones only, since a metatable could make a loop of C endless ---

void check_plain(lua_State* lua, int index) {
    luaL_checktype(lua, index, LUA_TTABLE);
    if (lua_getmetatable(lua, index)) luaL_argerror(lua, index, "a table without a metatable is needed here");
    charge(lua, static_cast<std::int64_t>(lua_rawlen(lua, index)));
}

/// Calls the original function, which is the upvalue, with all arguments.
int call_original(lua_State* lua) {
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    lua_call(lua, lua_gettop(lua) - 1, LUA_MULTRET);
    return lua_gettop(lua);
}

int on_plain_table(lua_State* lua) {
    check_plain(lua, 1);
    return call_original(lua);
}

void charge_range(lua_State* lua, lua_Integer first, lua_Integer last) {
    if (last < first) return;
    const auto count = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first);
    constexpr lua_Unsigned most = 1U << 30;  // far beyond any budget
    charge(lua, static_cast<std::int64_t>(std::min(count, most)) + 1);
}

int table_move(lua_State* lua) {
    check_plain(lua, 1);
    if (!lua_isnoneornil(lua, 5)) check_plain(lua, 5);
    charge_range(lua, luaL_checkinteger(lua, 2), luaL_checkinteger(lua, 3));
    return call_original(lua);
}

int table_unpack(lua_State* lua) {
    check_plain(lua, 1);
    const auto length = static_cast<lua_Integer>(lua_rawlen(lua, 1));
    charge_range(lua, luaL_optinteger(lua, 2, 1), luaL_optinteger(lua, 3, length));
    return call_original(lua);
}

/// True when the value at `a` of the table at 1 comes before that at `b`; both are values on the stack.
bool comes_before(lua_State* lua, int a, int b) {
    charge(lua, 1);
    if (lua_isnil(lua, 2)) return lua_compare(lua, a, b, LUA_OPLT) != 0;
    lua_pushvalue(lua, 2);
    lua_pushvalue(lua, a < 0 ? a - 1 : a);
    lua_pushvalue(lua, b < 0 ? b - 2 : b);
    lua_call(lua, 2, 1);
    const bool before = lua_toboolean(lua, -1) != 0;
    lua_pop(lua, 1);
    return before;
}

/// A stable merge sort: the same order in every run, at most n log2(n) comparisons, whatever the function answers.
int table_sort(lua_State* lua) {
    lua_settop(lua, 2);
    check_plain(lua, 1);
    if (!lua_isnil(lua, 2)) luaL_checktype(lua, 2, LUA_TFUNCTION);
    const auto count = static_cast<lua_Integer>(lua_rawlen(lua, 1));
    lua_createtable(lua, static_cast<int>(count), 0);
    int from = 1, to = 3;
    for (lua_Integer width = 1; width < count; width *= 2) {
        charge(lua, count);
        for (lua_Integer low = 1; low <= count; low += 2 * width) {
            const lua_Integer middle = std::min(low + width, count + 1), end = std::min(low + 2 * width, count + 1);
            lua_Integer left = low, right = middle;
            for (lua_Integer out = low; out < end; ++out) {
                bool take_right = left >= middle;
                if (left < middle && right < end) {
                    lua_rawgeti(lua, from, right);
                    lua_rawgeti(lua, from, left);
                    take_right = comes_before(lua, -2, -1);
                    lua_pop(lua, 2);
                }
                lua_rawgeti(lua, from, take_right ? right++ : left++);
                lua_rawseti(lua, to, out);
            }
        }
        std::swap(from, to);
    }
    for (lua_Integer i = 1; from == 3 && i <= count; ++i) {
        lua_rawgeti(lua, 3, i);
        lua_rawseti(lua, 1, i);
    }
    return 0;
}

// --- string ---

/// The original loops over the count even where nothing is repeated, so that ("").rep(1e18) would not end.
int string_rep(lua_State* lua) {
    std::size_t length = 0, gap = 0;
    luaL_checklstring(lua, 1, &length);
    const lua_Integer count = luaL_checkinteger(lua, 2);
    luaL_optlstring(lua, 3, "", &gap);
    if (length + gap == 0) {
        lua_pushstring(lua, "");
        return 1;
    }
    const auto longest = static_cast<lua_Integer>((1U << 30) / (length + gap));
    if (count > longest) return luaL_error(lua, "string.rep: the result would be too long");
    return call_original(lua);
}

int string_format(lua_State* lua) {
    std::size_t length = 0;
    const char* const text = luaL_checklstring(lua, 1, &length);
    const std::string_view format(text, length);
    for (std::size_t i = 0; i + 1 < format.size(); ++i) {
        if (format[i] != '%') continue;
        const std::size_t conversion = format.find_first_not_of("0123456789.-+# ", i + 1);
        if (conversion == std::string_view::npos) break;
        if (format[conversion] == 'p')
            return luaL_error(lua, "string.format: '%%p' shows an address, which changes from run to run");
        i = conversion;
    }
    for (int i = 2; i <= lua_gettop(lua); ++i) {
        const int type = lua_type(lua, i);
        if (type == LUA_TTABLE || type == LUA_TFUNCTION || type == LUA_TTHREAD || type == LUA_TUSERDATA) {
            push_text(lua, i);
            lua_replace(lua, i);
        }
    }
    return call_original(lua);
}

/// Replaces the field `name` of the table on top by `function`, which gets the original as its upvalue.
void wrap(lua_State* lua, const char* name, lua_CFunction function) {
    lua_getfield(lua, -1, name);
    lua_pushcclosure(lua, function, 1);
    lua_setfield(lua, -2, name);
}

void remove(lua_State* lua, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        lua_pushnil(lua);
        lua_setfield(lua, -2, name);
    }
}

}  // namespace

void open_safe_library(lua_State* lua, unsigned long long seed) {
    luaL_requiref(lua, "_G", luaopen_base, 1);
    // xpcall()'s handler runs inside of the hook that ended the step, where no hook is called: a loop in it would not
    // end.
    remove(lua, {"collectgarbage", "dofile", "load", "loadfile", "require", "warn", "xpcall"});
    wrap(lua, "next", next);
    wrap(lua, "pairs", pairs);
    wrap(lua, "print", print);
    wrap(lua, "setmetatable", set_metatable);
    wrap(lua, "tonumber", to_number);
    wrap(lua, "tostring", to_string);
    lua_pop(lua, 1);

    luaL_requiref(lua, "table", luaopen_table, 1);
    for (const char* name : {"concat", "insert", "remove"}) wrap(lua, name, on_plain_table);
    wrap(lua, "move", table_move);
    wrap(lua, "sort", table_sort);
    wrap(lua, "unpack", table_unpack);
    lua_pop(lua, 1);

    luaL_requiref(lua, "string", luaopen_string, 1);
    remove(lua, {"dump", "find", "gmatch", "gsub", "match", "pack", "packsize", "unpack"});
    wrap(lua, "format", string_format);
    wrap(lua, "rep", string_rep);
    lua_pop(lua, 1);
    lua_pushstring(lua, "");
    lua_getmetatable(lua, -1);
    lua_pushboolean(lua, 0);
    lua_setfield(lua, -2, "__metatable");
    lua_pop(lua, 2);

    luaL_requiref(lua, "math", luaopen_math, 1);
    lua_getfield(lua, -1, "randomseed");  // Lua's own seed is the time and an address
    lua_pushinteger(lua, static_cast<lua_Integer>(seed));
    lua_pushinteger(lua, 0);
    lua_call(lua, 2, 0);
    remove(lua, {"randomseed"});
    lua_pop(lua, 1);
}

}  // namespace blush
