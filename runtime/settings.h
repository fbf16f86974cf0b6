#pragma once
/// The settings of all effects, by name ("deformation.method"), each one of a few named choices or a
/// number in a range.

#include <cstdint>
#include <string_view>
#include <vector>

#include "rig/result.h"

namespace blush {

/// Who holds a setting: it is set on that object, and each may have its own.
enum class SettingOwner : std::uint8_t { character, scene, view };
std::string_view to_string(SettingOwner owner);

struct Effect;

/// One setting, found when compiled: its effect, and its place among that effect's.
struct SettingId {
    const Effect* effect = nullptr;
    std::uint16_t place = 0;
};

class EffectSettings {
public:
    EffectSettings();  ///< every setting at its default

    /// value: the name of a choice, or a number. Error: no such setting, no such choice (the message lists what there
    /// is), not a finite number or one outside the setting's range.
    Status set(std::string_view setting, std::string_view value);
    /// The same where the setting is that owner's; error also where it is another's.
    Status set(std::string_view setting, std::string_view value, SettingOwner owner);
    /// Error: no such setting.
    static Result<SettingOwner> owner_of(std::string_view setting);
    /// Index of the choice made. The setting must exist; its effect must be registered.
    std::uint8_t choice(SettingId setting) const;
    /// Value of a setting that is a number, likewise.
    double number(SettingId setting) const;

    /// The same by name, for what is asked now and then: compares strings. The setting must exist.
    std::uint8_t choice(std::string_view effect, std::string_view setting) const;

    double number(std::string_view effect, std::string_view setting) const;

    bool operator==(const EffectSettings&) const = default;

private:
    double value(std::string_view effect, std::string_view setting) const;

    std::vector<double> values_;  // number, or index of the choice, of every setting in the registry's order
};

}  // namespace blush
