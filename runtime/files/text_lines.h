#pragma once
/// Reading the lines of a text format: words, numbers and the sentence that names file and line.

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"

namespace blush::load {

/// Steps through a text line by line and through a line word by word (divided by blanks and tabs).
class TextLines {
public:
    /// `place` names the file in messages.
    TextLines(ByteView text, std::string_view place)
        : text_(reinterpret_cast<const char*>(text.data()), text.size()), place_(place) {}

    bool next_line() {
        if (next_ >= text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', next_), text_.size());
        line_ = text_.substr(next_, end - next_);
        if (line_.ends_with('\r')) line_.remove_suffix(1);
        next_ = end + 1;
        ++number_;
        return true;
    }

    /// The next word of the line; empty behind its last.
    std::string_view word() {
        const std::size_t first = std::min(line_.find_first_not_of(" \t"), line_.size());
        const std::size_t end = std::min(line_.find_first_of(" \t", first), line_.size());
        const std::string_view found = line_.substr(first, end - first);
        line_.remove_prefix(end);
        return found;
    }
    /// What is left of the line.
    std::string_view rest() const { return line_; }

    /// The next word as a number. Refuses what is none, what is not finite or beyond single precision.
    double number() { return number_in(word()); }

    double number_in(std::string_view text) const {
        const std::string_view whole = text;
        if (text.starts_with('+')) text.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        constexpr double largest = 3.4e38;  // just within a float
        if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= largest))
            bad_line(quoted(whole) + " is not a finite number");
        return value;
    }

    /// A whole number from `first` to `first + count - 1`, less `first`.
    std::size_t index_in(std::string_view text, std::size_t first, std::size_t count, std::string_view what) const {
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size()) bad_line(quoted(text) + " is not an index");
        if (value < first || value - first >= count)
            bad_line(std::string(what) + " " + std::string(text) + " does not exist, there are " +
                     std::to_string(count));
        return value - first;
    }

    [[noreturn]] void bad_line(std::string_view reason) const {
        refuse((place_.empty() ? "" : place_ + ":") + std::to_string(number_), reason);
    }

private:
    static std::string quoted(std::string_view text) { return "\"" + std::string(text.substr(0, 40)) + "\""; }

    std::string_view text_, line_;
    std::string place_;
    std::size_t next_ = 0, number_ = 0;
};

}  // namespace blush::load
