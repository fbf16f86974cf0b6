#include "rig/names.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace blush {

const std::array<std::string_view, 52> arkit_names = {
    "eyeBlinkLeft",      "eyeLookDownLeft",    "eyeLookInLeft",
    "eyeLookOutLeft",    "eyeLookUpLeft",      "eyeSquintLeft",
    "eyeWideLeft",       "eyeBlinkRight",      "eyeLookDownRight",
    "eyeLookInRight",    "eyeLookOutRight",    "eyeLookUpRight",
    "eyeSquintRight",    "eyeWideRight",       "jawForward",
    "jawLeft",           "jawRight",           "jawOpen",
    "mouthClose",        "mouthFunnel",        "mouthPucker",
    "mouthLeft",         "mouthRight",         "mouthSmileLeft",
    "mouthSmileRight",   "mouthFrownLeft",     "mouthFrownRight",
    "mouthDimpleLeft",   "mouthDimpleRight",   "mouthStretchLeft",
    "mouthStretchRight", "mouthRollLower",     "mouthRollUpper",
    "mouthShrugLower",   "mouthShrugUpper",    "mouthPressLeft",
    "mouthPressRight",   "mouthLowerDownLeft", "mouthLowerDownRight",
    "mouthUpperUpLeft",  "mouthUpperUpRight",  "browDownLeft",
    "browDownRight",     "browInnerUp",        "browOuterUpLeft",
    "browOuterUpRight",  "cheekPuff",          "cheekSquintLeft",
    "cheekSquintRight",  "noseSneerLeft",      "noseSneerRight",
    "tongueOut",
};

namespace {

// Plain ASCII, whatever the locale; other bytes of a UTF-8 name stay as they are.
bool is_separator(char c) { return c == '_' || c == '-' || c == ' ' || c == '.'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
char to_lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

/// "left" or "right" where the name ends in a lone L or R that is a side mark, else empty.
std::string_view side_of_last_letter(std::string_view name) {
    if (name.size() < 2) return {};
    const char last = name.back(), before = name[name.size() - 2];
    // After a separator either case marks a side; after a lower-case letter or a digit only a capital does
    // ("mouthFunnel", "AU12L").
    const bool ends_a_word = is_lower(before) || (before >= '0' && before <= '9');
    if (!is_separator(before) && !(ends_a_word && is_upper(last))) return {};
    if (to_lower(last) == 'l') return "left";
    if (to_lower(last) == 'r') return "right";
    return {};
}

/// The name without what an exporter put before it ("blendShape1.jawOpen"), or empty where nothing is before it. A '.'
/// that only sets off a side mark or a number ("mouthSmile.L", "jawOpen.001") does not end such a prefix.
std::string_view without_prefix(std::string_view name) {
    for (std::size_t dot = name.rfind('.'); dot != std::string_view::npos && dot > 0; dot = name.rfind('.', dot - 1)) {
        const std::string_view rest = name.substr(dot + 1);
        const std::string folded = canonical_name(rest);
        const bool is_side = folded == "l" || folded == "r" || folded == "left" || folded == "right";
        if (!rest.empty() && (is_lower(rest[0]) || is_upper(rest[0])) && !is_side) return rest;
    }
    return {};
}

constexpr std::size_t ambiguous = std::numeric_limits<std::size_t>::max();

void add_unique(std::unordered_map<std::string, std::size_t>& map, std::string key, std::size_t index) {
    const auto [entry, added] = map.try_emplace(std::move(key), index);
    if (!added) entry->second = ambiguous;
}

/// Edits (insert, delete, replace, swap of neighbours: Damerau 1964) that turn one text into the other.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

}  // namespace

std::string canonical_name(std::string_view name) {
    while (!name.empty() && is_separator(name.back())) name.remove_suffix(1);
    const std::string_view side = side_of_last_letter(name);
    if (!side.empty()) name.remove_suffix(1);
    std::string folded;
    folded.reserve(name.size() + side.size());
    for (const char c : name) {
        if (!is_separator(c)) folded += to_lower(c);
    }
    return folded.append(side);
}

NameIndex::NameIndex(std::span<const std::string> names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        identical_.try_emplace(names[i], i);
        std::string folded = canonical_name(names[i]);
        const std::string_view rest = without_prefix(names[i]);
        add_unique(without_prefix_, rest.empty() ? folded : canonical_name(rest), i);
        add_unique(canonical_, std::move(folded), i);
    }
}

std::optional<std::size_t> NameIndex::find(std::string_view name) const {
    if (const auto entry = identical_.find(std::string(name)); entry != identical_.end()) return entry->second;
    const auto unique = [](const auto& entry) {
        return entry->second == ambiguous ? std::nullopt : std::optional(entry->second);
    };
    const std::string folded = canonical_name(name);
    if (const auto entry = canonical_.find(folded); entry != canonical_.end()) return unique(entry);
    const std::string_view rest = without_prefix(name);
    const auto entry = without_prefix_.find(rest.empty() ? folded : canonical_name(rest));
    return entry == without_prefix_.end() ? std::nullopt : unique(entry);
}

std::optional<std::size_t> find_name(std::string_view name, std::span<const std::string> names) {
    return NameIndex(names).find(name);
}

std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> names) {
    // No name that a person types is longer, and the table below costs the product of both lengths.
    constexpr std::size_t longest = 200;
    const std::string wanted = canonical_name(name);
    if (wanted.empty() || wanted.size() > longest) return std::nullopt;
    // A third of the letters: "moutSmileLeft" still finds its name, "tail" does not become "jawOpen".
    std::size_t allowed = std::max<std::size_t>(1, wanted.size() / 3);
    const std::string* nearest = nullptr;
    for (const std::string& candidate : names) {
        if (candidate.size() > longest) continue;
        const std::size_t distance = edit_distance(wanted, canonical_name(candidate));
        if (distance < allowed || (distance == allowed && !nearest)) {
            allowed = distance;
            nearest = &candidate;
        }
    }
    return nearest ? std::optional(*nearest) : std::nullopt;
}

}  // namespace blush
