#include "runtime/files/json_text.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "runtime/files/performance/performance_text.h"

namespace blush {
namespace {

/// The formats nest five deep; anything much deeper is none of them.
constexpr int most_depth = 16;
/// Ordered objects look a key up by walking through all of them, so that their number must have an end.
constexpr std::size_t most_keys = 16'384;
/// A parsed key pair takes some twenty times the bytes of its text.
constexpr std::size_t most_bytes = 64U << 20;

/// Thrown by the parser's callback and caught in parse(): nlohmann offers no other way to stop.
struct Refusal {
    std::string reason;
};

/// Refuses depth, size and repeated keys while the text is read.
class Guard {
public:
    bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
        using Event = Json::parse_event_t;
        if (depth > most_depth) throw Refusal{"nested more than " + std::to_string(most_depth) + " deep"};
        if (event == Event::object_start) keys_.emplace_back();
        if (event == Event::object_end) keys_.pop_back();
        if (event == Event::key) {
            const auto& key = parsed.get_ref<const std::string&>();
            if (!keys_.back().insert(key).second)
                throw Refusal{"the key " + in_quotes(key) + " is there twice in one object"};
            if (keys_.back().size() > most_keys) {
                throw Refusal{"an object has more than " + std::to_string(most_keys) + " keys"};
            }
        }
        return true;
    }

private:
    std::vector<std::set<std::string>> keys_;
};

std::string line_and_column(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const std::size_t line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

/// The library's own words for what it found, without its error code and place.
std::string syntax_reason(std::string_view what) {
    for (const std::string_view mark : {"] ", "column ", ": ", " - "}) {
        const std::size_t found = what.find(mark);
        if (found != std::string_view::npos) what.remove_prefix(found + mark.size());
    }
    std::string reason;
    for (const char c : what) reason += (c >= ' ' && c <= '~') ? c : '?';
    return reason;
}

}  // namespace

Result<Json> parse_json(std::string_view text, const std::string& file, const std::string& what) {
    if (text.size() > most_bytes) {
        return Error{file + ": " + what + " may have " + std::to_string(most_bytes >> 20) + " MiB, this has " +
                     std::to_string(text.size() >> 20)};
    }
    try {
        return Json::parse(text.begin(), text.end(), Guard());
    } catch (const Refusal& refusal) {
        return Error{file + ": " + refusal.reason};
    } catch (const Json::parse_error& error) {
        const std::size_t offset = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
        return Error{file + ": " + line_and_column(text, offset) + ": not valid JSON: " + syntax_reason(error.what())};
    } catch (const Json::exception& error) {
        // What is left is a number beyond a double's range, quoted in the library's words but without its place.
        std::string_view words = error.what();
        const std::size_t open = words.find('\''), close = words.rfind('\'');
        const std::string_view number =
            open < close ? words.substr(open + 1, close - open - 1) : std::string_view("a number");
        const std::size_t offset = text.find(number);
        return Error{file + ": " + line_and_column(text, offset == std::string_view::npos ? 0 : offset) + ": " +
                     in_quotes(number) + " is out of range"};
    }
}

}  // namespace blush
