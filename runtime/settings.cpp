#include "runtime/settings.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "runtime/frame/effect.h"

namespace blush {
namespace {

/// Calls visit(effect, setting, index) for every setting until it returns true.
template <class Visit>
void each_setting(Visit visit) {
    std::size_t index = 0;
    for (const Effect* effect : effects()) {
        for (const Setting& setting : effect->settings) {
            if (visit(*effect, setting, index++)) return;
        }
    }
}

std::string plain(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// The value that `text` means for `setting`.
Result<double> parse_value(const std::string& name, const Setting& setting, std::string_view text) {
    if (setting.choices.empty()) {
        const std::optional<double> number = parse_number(text);
        if (number && *number >= setting.lowest && *number <= setting.highest) return *number;
        return Error{"setting " + name + " takes a number from " + plain(setting.lowest) + " to " +
                     plain(setting.highest) + ", not \"" + std::string(text) + "\""};
    }
    std::string known;
    for (std::size_t c = 0; c < setting.choices.size(); ++c) {
        if (setting.choices[c] == text) return static_cast<double>(c);
        known += (known.empty() ? "" : ", ") + std::string(setting.choices[c]);
    }
    return Error{"setting " + name + " has no choice \"" + std::string(text) + "\" (there are: " + known + ")"};
}

}  // namespace

EffectSettings::EffectSettings() {
    each_setting([&](const Effect&, const Setting& setting, std::size_t) {
        values_.push_back(setting.choices.empty() ? setting.default_number : setting.default_choice);
        return false;
    });
}

Status EffectSettings::set(std::string_view setting_name, std::string_view text) {
    std::string known_settings;
    Status done = Done{};
    bool exists = false;
    each_setting([&](const Effect& effect, const Setting& setting, std::size_t index) {
        const std::string full = std::string(effect.name) + "." + std::string(setting.name);
        known_settings += (known_settings.empty() ? "" : ", ") + full;
        if (full != setting_name) return false;
        exists = true;
        const Result<double> parsed = parse_value(full, setting, text);
        if (parsed) {
            values_[index] = *parsed;
        } else {
            done = parsed.error();
        }
        return true;
    });
    if (exists) return done;
    return Error{"no setting is called \"" + std::string(setting_name) + "\" (there are: " + known_settings + ")"};
}

std::string_view to_string(SettingOwner owner) {
    switch (owner) {
        case SettingOwner::character:
            return "character";
        case SettingOwner::scene:
            return "scene";
        case SettingOwner::view:
            break;
    }
    return "view";
}

Result<SettingOwner> EffectSettings::owner_of(std::string_view setting_name) {
    std::optional<SettingOwner> owner;
    std::string known;
    each_setting([&](const Effect& effect, const Setting& setting, std::size_t) {
        const std::string full = std::string(effect.name) + "." + std::string(setting.name);
        known += (known.empty() ? "" : ", ") + full;
        if (full == setting_name) owner = setting.owner.value_or(effect.owner);
        return owner.has_value();
    });
    if (owner) return *owner;
    return Error{"no setting is called \"" + std::string(setting_name) + "\" (there are: " + known + ")"};
}

Status EffectSettings::set(std::string_view setting, std::string_view value, SettingOwner owner) {
    const Result<SettingOwner> holder = owner_of(setting);
    if (!holder) return holder.error();
    if (*holder == owner) return set(setting, value);
    return Error{"setting " + std::string(setting) + " is the " + std::string(to_string(*holder)) + "'s, not the " +
                 std::string(to_string(owner)) + "'s"};
}

double EffectSettings::value(std::string_view effect_name, std::string_view setting_name) const {
    double found = 0;
    [[maybe_unused]] bool exists = false;
    each_setting([&](const Effect& effect, const Setting& setting, std::size_t index) {
        if (effect.name != effect_name || setting.name != setting_name) return false;
        found = values_[index];
        exists = true;
        return true;
    });
    assert(exists && "EffectSettings: no such setting");
    return found;
}

double EffectSettings::number(SettingId setting) const {
    std::size_t first = 0;
    for (const Effect* effect : effects()) {
        if (effect == setting.effect) return values_[first + setting.place];
        first += effect->settings.size();
    }
    assert(false && "EffectSettings: the effect is not registered");
    return 0;
}

std::uint8_t EffectSettings::choice(SettingId setting) const { return static_cast<std::uint8_t>(number(setting)); }

std::uint8_t EffectSettings::choice(std::string_view effect, std::string_view setting) const {
    return static_cast<std::uint8_t>(value(effect, setting));
}

double EffectSettings::number(std::string_view effect, std::string_view setting) const {
    return value(effect, setting);
}

}  // namespace blush
