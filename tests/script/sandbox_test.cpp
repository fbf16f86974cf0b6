/// What a script must not be able to do: reach outside, run for ever, take all memory, differ from run to run.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/script/script_run.h"

namespace blush {
namespace {

using test::error_of;
using test::ScriptRun;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* too_long =
    "the script did not come to a wait() or its end within 200000 instructions of one step";

TEST(Sandbox, NothingLeadsOutside) {
    for (const char* name : {"io",
                             "os",
                             "debug",
                             "package",
                             "coroutine",
                             "utf8",
                             "require",
                             "load",
                             "loadstring",
                             "loadfile",
                             "dofile",
                             "collectgarbage",
                             "warn",
                             "string.find",
                             "string.match",
                             "string.gsub",
                             "string.gmatch",
                             "string.dump",
                             "string.pack",
                             "string.unpack",
                             "math.randomseed",
                             "string.packsize"}) {
        EXPECT_EQ(error_of("if " + std::string(name) + " ~= nil then error('there') end"), "") << name;
    }
    EXPECT_EQ(error_of("assert(getmetatable('') == false)"), "");
    EXPECT_THAT(error_of("setmetatable('', {})"), StartsWith("folder/test.lua:1: bad argument #1 to 'setmetatable'"));
    EXPECT_EQ(error_of("setmetatable({}, {__gc = function() while true do end end})"),
              "folder/test.lua:1: setmetatable: '__gc' is not allowed in scripts");
    EXPECT_EQ(error_of("for k in pairs(_G) do if k == 'io' or k == 'os' then error(k) end end"), "");
    EXPECT_THAT(error_of("\x1bLua"), HasSubstr("attempt to load a binary chunk"));
}

TEST(Sandbox, WhatIsLeftWorks) {
    EXPECT_EQ(error_of(R"(
        local t = {3, 1, 2}
        table.sort(t) assert(table.concat(t, ",") == "1,2,3")
        table.sort(t, function(a, b) return a > b end) assert(table.concat(t) == "321")
        table.insert(t, 4) assert(#t == 4 and table.remove(t) == 4)
        assert(select("#", table.unpack(t)) == 3)
        assert(table.concat(table.move({1, 2}, 1, 2, 2, {9})) == "912")
        assert(("ab"):rep(3, "-") == "ab-ab-ab" and ("x"):upper() == "X" and ("abc"):sub(2) == "bc")
        assert((""):rep(1000000000000) == "" and ("a"):rep(0) == "")
        assert(string.format("%5.2f %s %d %%", 1.5, "s", 3) == " 1.50 s 3 %")
        assert(tonumber("0x10") == 16 and tonumber("z", 36) == 35 and tostring(nil) == "nil")
        assert(next({}) == nil and next({a = 1}) == "a" and rawlen({1, 2}) == 2)
        assert(not pcall(error, "x") and select(2, pcall(error, "x")) == "x")
        local sum = 0 for i, v in ipairs({1, 2, 3}) do sum = sum + i * v end assert(sum == 14)
        local p = setmetatable({}, {__index = function(_, k) return k .. "!" end}) assert(p.hi == "hi!")
        assert(math.floor(2.5) == 2 and math.type(1) == "integer" and random(1, 1) == 1))"),
              "");
}

TEST(Sandbox, WhatNeverEndsIsEnded) {
    const std::vector<std::pair<const char*, const char*>> scripts = {
        {"while true do end", "1"},
        {"local x = 0\nrepeat x = x + 1 until false", "2"},
        {"goto a ::a:: goto a", "1"},
        {"while true do pcall(function() while true do end end) end", "1"},
        {"local function f() pcall(f) while true do end end f()", "1"},
        {"while true do start(function() end) wait(0.0) pcall(error) while true do end end", "1"},
        {"local t = setmetatable({}, {__index = function(t, k) return t[k + 1] end}) pcall(function() return t[1] end) "
         "while true do end",
         "1"},
        {"on('x', function() emit('x') end) emit('x')", "1"},
        {"local x <close> = setmetatable({}, {__close = function() while true do end end})", "1"},
        {"table.sort({3, 2, 1}, function() while true do end end)", "1"},
        {"table.move({}, 1, math.maxinteger, 2)", "1"},
        {"for i = 1, 1e9 do table.unpack({}, 1, 1e3) end", "1"},
        {"pcall(table.unpack, {}, 1, 1e8) for i = 1, 1e9 do end", "1"},
        {"local s = ('x'):rep(200000) while true do local y = s .. 'z' end", "1"},
        {"while true do pcall(string.rep, 'x', 1e8) end", "1"},
        {"local t = {} for i = 1, 4000 do t[i] = i end while true do table.concat(t) end", "1"},
        {"local t = {} for i = 1, 4000 do t[i] = i end while true do for k in pairs(t) do end end", "1"},
        {"local t = {} for i = 1, 4000 do t[i] = i end while true do next(t, 3) end", "1"},
        {"local s = ('9'):rep(200000) while true do tonumber(s) end", "1"},
        {"while true do print('x') end", "1"},
        {"while true do wait(1e-300) end", "1"},
        {"every(0.001, function() while true do end end)", "1"},
    };
    for (const auto& [text, line] : scripts) {
        EXPECT_THAT(error_of(text), testing::AnyOf("folder/test.lua:" + std::string(line) + ": " + too_long,
                                                   std::string("folder/test.lua: ") + too_long))
            << text;
    }
}

TEST(Sandbox, AThousandStepsOfALongButEndingLoopAreFine) {
    EXPECT_EQ(ScriptRun("while true do for i = 1, 50000 do end wait(0.01) end").to(1).error, "");
}

TEST(Sandbox, MemoryHasAnEnd) {
    EXPECT_EQ(error_of("local s = 'x'\nwhile true do s = s .. s end"),
              "folder/test.lua:2: a string or table of more than 256 KiB is asked for");
    EXPECT_EQ(error_of("local s = ('x'):rep(1000000000)"),
              "folder/test.lua:1: a string or table of more than 256 KiB is asked for");
    EXPECT_EQ(error_of("local s = ('x'):rep(1e18)"), "folder/test.lua:1: string.rep: the result would be too long");
    EXPECT_EQ(error_of("local t = {}\nfor i = 1, 1e9 do t[i] = i end"),
              "folder/test.lua:2: a string or table of more than 256 KiB is asked for");
    EXPECT_EQ(error_of("local function f() return 1 + f() end\nf()"),
              "folder/test.lua:1: calls are nested too deep; a function calls itself without end");
    // A little a step: the bound on work is kept, that on memory is not.
    ScriptRun hoarder(
        "local t = {}\nwhile true do for i = 1, 100 do t[#t + 1] = ('x'):rep(4000) .. #t end\nwait(0.01) end");
    EXPECT_EQ(hoarder.to(10).error, "folder/test.lua:2: the script needs more than 16 MiB of memory");
    // What a script catches has been refused all the same.
    EXPECT_EQ(error_of("assert(not pcall(string.rep, 'x', 1e8))"), "");
}

TEST(Sandbox, MessagesNameFileAndLine) {
    EXPECT_EQ(error_of("feel('joy', 0.8\nwait(1)"),
              "folder/test.lua:2: ')' expected (to close '(' at line 1) near 'wait'");
    EXPECT_EQ(error_of("\n\nfeal('joy', 1)"), "folder/test.lua:3: attempt to call a nil value (global 'feal')");
    EXPECT_EQ(error_of("error('my own words')"), "folder/test.lua:1: my own words");
    EXPECT_EQ(error_of("\nerror({})"), "folder/test.lua:2: error() was called with a table");
    EXPECT_EQ(error_of("\nerror()"), "folder/test.lua:2: error() was called with a nil");
    EXPECT_EQ(error_of("local x = nil\nlocal y = x.z"), "folder/test.lua:2: attempt to index a nil value (local 'x')");
    EXPECT_EQ(error_of("error(('x'):rep(1000) .. '\\n')").size(), std::string("folder/test.lua:1: ").size() + 400 - 12);
    EXPECT_EQ(error_of("start(function()\n wait(0.1)\n error('late') end)"), "folder/test.lua:3: late");
}

TEST(Sandbox, OrdersAndTextsAreTheSameInEveryRun) {
    const std::string text = R"(
        local t = {}
        for _, k in ipairs({"sadness", "joy", "zebra", "anger", "b", "a", 3, 1, 2.5, -1, true, false}) do t[k] = 1 end
        local order = {}
        for k in pairs(t) do order[#order + 1] = tostring(k) end
        print(table.concat(order, " "))
        local k, again = nil, {}
        repeat k = next(t, k) if k ~= nil then again[#again + 1] = tostring(k) end until k == nil
        assert(table.concat(order) == table.concat(again))
        print({}, print, string.format("%s", {}))
        print(random(1000000), random(1000000))
        local r = {} for i = 1, 20 do r[i] = {i % 3, i} end
        table.sort(r, function(a, b) return a[1] < b[1] end)
        for i = 1, 20 do r[i] = r[i][2] end print(table.concat(r, " "))
    )";
    ScriptRun first(text), second(text);
    EXPECT_EQ(first.to(0).error, "");
    EXPECT_EQ(second.to(0).error, "");
    EXPECT_EQ(first.printed, second.printed);
    ASSERT_EQ(first.printed.size(), 4U);
    EXPECT_EQ(first.printed[0], "-1 1 3 2.5 a anger b joy sadness zebra false true");
    EXPECT_EQ(first.printed[1], "table\tfunction\ttable");
    EXPECT_EQ(first.printed[3], "3 6 9 12 15 18 1 4 7 10 13 16 19 2 5 8 11 14 17 20") << "sorting is stable";

    ScriptOptions other;
    other.seed = 2;
    ScriptRun third(text, other);
    third.to(0);
    EXPECT_NE(third.printed[2], first.printed[2]);
    EXPECT_EQ(error_of("for k in pairs({[{}] = 1}) do end"),
              "folder/test.lua:1: pairs: a key is a table; only numbers, strings and booleans have the same order in "
              "every run");
    EXPECT_EQ(error_of("print(string.format('%p', {}))"),
              "folder/test.lua:1: string.format: '%p' shows an address, which changes from run to run");
}

TEST(Sandbox, PairsSeesWhatIsTakenOutMeanwhile) {
    EXPECT_EQ(error_of(R"(
        local t, n = {a = 1, b = 2, c = 3}, 0
        for k in pairs(t) do n = n + 1 t.b = nil t[k] = nil end
        assert(n == 2 and next(t) == nil))"),
              "");
}

TEST(Sandbox, MetatablesDoNotMakeLoopsOfTheLibraryEndless) {
    const std::string endless = "setmetatable({}, {__len = function() return 1e18 // 1 | 0 end, __index = tostring})";
    for (const char* call : {"table.concat(T)", "table.unpack(T)", "table.insert(T, 1, 1)", "table.remove(T, 1)",
                             "table.sort(T)", "table.move(T, 1, 5, 2)", "table.move({}, 1, 5, 2, T)"}) {
        EXPECT_THAT(error_of("local T = " + endless + "\n" + call),
                    HasSubstr("a table without a metatable is needed here"))
            << call;
    }
}

}  // namespace
}  // namespace blush
