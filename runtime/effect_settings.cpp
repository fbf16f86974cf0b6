#include "runtime/effect_settings.h"

#include <cassert>
#include <string>

#include "runtime/effect.h"

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

}  // namespace

EffectSettings::EffectSettings() {
    each_setting([&](const Effect&, const Setting& setting, std::size_t) {
        choices_.push_back(setting.default_choice);
        return false;
    });
}

Status EffectSettings::set(std::string_view setting_name, std::string_view choice_name) {
    std::string known_settings, known_choices;
    bool done = false;
    each_setting([&](const Effect& effect, const Setting& setting, std::size_t index) {
        const std::string full = std::string(effect.name) + "." + std::string(setting.name);
        known_settings += (known_settings.empty() ? "" : ", ") + full;
        if (full != setting_name) return false;
        for (std::size_t c = 0; c < setting.choices.size(); ++c) {
            known_choices += (known_choices.empty() ? "" : ", ") + std::string(setting.choices[c]);
            if (setting.choices[c] != choice_name) continue;
            choices_[index] = static_cast<std::uint8_t>(c);
            done = true;
        }
        return true;
    });
    if (done) return Done{};
    if (known_choices.empty()) {
        return Error{"no setting is called \"" + std::string(setting_name) + "\" (there are: " + known_settings + ")"};
    }
    return Error{"setting " + std::string(setting_name) + " has no choice \"" + std::string(choice_name) +
                 "\" (there are: " + known_choices + ")"};
}

std::uint8_t EffectSettings::choice(std::string_view effect_name, std::string_view setting_name) const {
    std::uint8_t found = 0;
    [[maybe_unused]] bool exists = false;
    each_setting([&](const Effect& effect, const Setting& setting, std::size_t index) {
        if (effect.name != effect_name || setting.name != setting_name) return false;
        found = choices_[index];
        exists = true;
        return true;
    });
    assert(exists && "EffectSettings::choice: no such setting");
    return found;
}

}  // namespace blush
