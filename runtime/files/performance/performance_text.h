#pragma once
/// What both performance readers share: how a piece of a file is shown in a message.

#include <string>
#include <string_view>

namespace blush {

/// `text` in quotes for a message: at most 40 bytes of it, with '?' for what is not printable ASCII.
inline std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result = "'";
    for (const char c : text.substr(0, longest)) result += (c >= ' ' && c <= '~') ? c : '?';
    return result + (text.size() > longest ? "...'" : "'");
}

}  // namespace blush
