#include "rig/controls/control_table.h"

#include <algorithm>
#include <utility>

namespace blush {

const std::array<std::string_view, 9> angle_names = {
    "headYaw",     "headPitch",   "headRoll",      "leftEyeYaw",   "leftEyePitch",
    "leftEyeRoll", "rightEyeYaw", "rightEyePitch", "rightEyeRoll",
};

namespace {

/// A shape's name without its side ("mouthSmileleft", folded), or the whole; jawLeft and mouthLeft name a direction.
std::pair<std::string_view, bool> stem_of(std::string_view folded) {
    for (const std::string_view side : {"left", "right"}) {
        if (!folded.ends_with(side)) continue;
        const std::string_view stem = folded.substr(0, folded.size() - side.size());
        if (stem != "jaw" && stem != "mouth") return {stem, true};
    }
    return {folded, false};
}

/// Whether the name is one of ARKit's, or one of them with a side more or less.
bool is_arkit_shape(std::string_view name) {
    const std::string folded = canonical_name(name);
    const std::string_view stem = stem_of(folded).first;
    return std::ranges::any_of(arkit_names, [&](std::string_view known) {
        const std::string other = canonical_name(known);
        return stem_of(other).first == stem;
    });
}

}  // namespace

ControlTable::ControlTable(const Face& face, const RigDescription& description) : target_count(face.targets.size()) {
    for (const Target& target : face.targets) add(target.name, {ControlKind::target, 0, 1, ""});
    targets_ = NameIndex(names);
    for (const std::string_view name : angle_names) add(std::string(name), {ControlKind::angle, -1, 1, ""});
    all_ = NameIndex(names);
    for (const std::string_view name : arkit_names) {
        if (!is_own(name) && !parts_of(name).empty()) add(std::string(name), {ControlKind::arkit, 0, 1, ""});
    }
    of_expression.resize(description.expressions.size());
    for (const ControlKind kind :
         {ControlKind::action_unit, ControlKind::emotion, ControlKind::compound, ControlKind::state}) {
        for (std::size_t i = 0; i < description.expressions.size(); ++i) {
            const Expression& expression = description.expressions[i];
            if (expression.kind != kind) continue;
            const std::optional<std::size_t> own = targets_.find(expression.name);
            of_expression[i] = static_cast<std::uint32_t>(own.value_or(names.size()));
            if (!own) add(expression.name, {kind, 0, 1, expression.meaning});
        }
    }
    all_ = NameIndex(names);
}

void ControlTable::add(std::string name, ControlInfo info) {
    names.push_back(std::move(name));
    infos.push_back(std::move(info));
}

std::optional<std::uint32_t> ControlTable::find(std::string_view name) const {
    // The face's own names come first: no expression makes one of them ambiguous.
    std::optional<std::size_t> index = targets_.find(name);
    if (!index) index = all_.find(name);
    if (!index) return std::nullopt;
    return static_cast<std::uint32_t>(*index);
}

std::vector<std::uint32_t> ControlTable::sides_of(std::string_view name) const {
    std::vector<std::uint32_t> sides;
    if (!is_arkit_shape(name)) return sides;
    for (const char* side : {"Left", "Right"}) {
        const auto target = targets_.find(std::string(name) + side);
        if (target) sides.push_back(static_cast<std::uint32_t>(*target));
    }
    return sides;
}

std::optional<std::uint32_t> ControlTable::without_side(std::string_view name) const {
    if (!is_arkit_shape(name)) return std::nullopt;
    const std::string folded = canonical_name(name);
    const auto [stem, had_side] = stem_of(folded);
    if (!had_side) return std::nullopt;
    const auto target = targets_.find(stem);
    if (!target) return std::nullopt;
    return static_cast<std::uint32_t>(*target);
}

std::vector<ControlShare> ControlTable::driven_by(std::string_view name) const {
    if (const auto control = find(name)) return {{*control, 1}};
    return parts_of(name);
}

std::vector<ControlShare> ControlTable::parts_of(std::string_view name) const {
    std::vector<ControlShare> shares;
    for (const std::uint32_t side : sides_of(name)) shares.push_back({side, 1});
    if (!shares.empty()) return shares;
    if (const auto whole = without_side(name)) return {{*whole, 0.5F}};
    return {};
}

std::vector<ControlShare> ControlTable::read_from(std::string_view name) const {
    const auto control = find(name);
    if (control && infos[*control].kind != ControlKind::arkit) return {{*control, 1}};
    std::vector<ControlShare> shares;
    for (const std::uint32_t side : sides_of(name)) shares.push_back({side, 0.5F});
    if (!shares.empty()) return shares;
    if (const auto whole = without_side(name)) return {{*whole, 1}};
    return {};
}

bool ControlTable::knows(std::string_view name) const { return find(name).has_value() || is_arkit_shape(name); }

std::vector<std::string> ControlTable::unmatched_arkit() const {
    std::vector<std::string> unmatched;
    for (const std::string_view name : arkit_names) {
        if (!find(name)) unmatched.emplace_back(name);
    }
    return unmatched;
}

}  // namespace blush
