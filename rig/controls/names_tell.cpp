// The description that a face gets from its target names.

#include <algorithm>
#include <charconv>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "rig/controls/expression_library.h"
#include "rig/controls/rig_description.h"
#include "rig/names.h"

namespace blush {
namespace {

using Names = std::unordered_set<std::string_view>;

/// "jawOpen_50": what an in-between is called, or nothing.
struct Numbered {
    std::string_view base, digits;
};
Numbered split_number(std::string_view name) {
    const std::size_t underscore = name.rfind('_');
    if (underscore == std::string_view::npos || underscore == 0) return {};
    const std::string_view digits = name.substr(underscore + 1);
    const bool number = !digits.empty() && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
    return number ? Numbered{name.substr(0, underscore), digits} : Numbered{};
}

/// Two digits, a multiple of 5 from 05 to 95: a percentage, and not the number of a copy or of a scan.
int percentage(std::string_view digits) {
    int value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return digits.size() == 2 && value > 0 && value % 5 == 0 ? value : 0;
}

std::vector<InBetween> in_betweens_of(const Face& face, const Names& names) {
    std::unordered_map<std::string_view, bool> all_are_percentages;
    for (const Target& target : face.targets) {
        const Numbered split = split_number(target.name);
        if (split.base.empty()) continue;
        const auto entry = all_are_percentages.try_emplace(split.base, true).first;
        entry->second = entry->second && percentage(split.digits) > 0;
    }
    std::vector<InBetween> found;
    Names seen;
    for (const Target& target : face.targets) {
        if (!seen.insert(target.name).second) continue;
        const Numbered split = split_number(target.name);
        if (split.base.empty() || !names.contains(split.base) || !all_are_percentages.at(split.base)) continue;
        if (!split_number(split.base).base.empty()) continue;  // "x_50_25": whose in-between is in doubt
        found.push_back({std::string(split.base), target.name, static_cast<float>(percentage(split.digits)) / 100});
    }
    return found;
}

/// All ways to write a name as parts joined by '_'; stops at two, since two are one too many.
class Segmentation {
public:
    explicit Segmentation(const Names& parts) : parts_(parts) {}

    std::vector<std::vector<std::string_view>> of(std::string_view name) {
        ways_.clear();
        // Names of combinations are short; this bounds the search on what is none.
        constexpr std::ptrdiff_t most_underscores = 12;
        if (std::ranges::count(name, '_') <= most_underscores) extend(name, name);
        return ways_;
    }

private:
    void extend(std::string_view whole, std::string_view rest) {
        for (std::size_t end = rest.find('_'); ways_.size() < 2; end = rest.find('_', end + 1)) {
            const std::string_view part = rest.substr(0, end);
            if (part != whole && parts_.contains(part)) {
                way_.push_back(part);
                if (end == std::string_view::npos) {
                    ways_.push_back(way_);
                } else {
                    extend(whole, rest.substr(end + 1));
                }
                way_.pop_back();
            }
            if (end == std::string_view::npos) return;
        }
    }

    const Names& parts_;
    std::vector<std::string_view> way_;
    std::vector<std::vector<std::string_view>> ways_;
};

std::vector<Corrective> correctives_of(const Face& face, const Names& names) {
    // "a_b_c" beside "a_b" is driven by a, b and c: combinations are no parts.
    Names single;
    Segmentation any(names);
    for (const Target& target : face.targets) {
        if (any.of(target.name).empty()) single.insert(target.name);
    }
    std::vector<Corrective> found;
    Segmentation of_singles(single);
    Names seen;
    for (const Target& target : face.targets) {
        if (single.contains(target.name) || !seen.insert(target.name).second) continue;
        const auto ways = of_singles.of(target.name);
        if (ways.size() != 1) continue;
        const Names drivers(ways[0].begin(), ways[0].end());
        if (drivers.size() != ways[0].size()) continue;
        found.push_back({.target = target.name, .drivers = {ways[0].begin(), ways[0].end()}});
    }
    return found;
}

}  // namespace

RigDescription default_description(const Face& face) {
    RigDescription description = expression_library();
    Names names;
    for (const Target& target : face.targets) {
        if (!target.name.empty()) names.insert(target.name);
    }
    description.in_betweens = in_betweens_of(face, names);
    description.correctives = correctives_of(face, names);
    return description;
}

}  // namespace blush
