#pragma once
/// What a setting is: of an effect, which frames read, or of a baker, which `blush bake` reads. No GL.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/settings.h"

namespace blush {

/// One of a few named choices, or (without choices) a number in a range.
struct Setting {
    std::string_view name;
    std::string_view meaning;
    std::span<const std::string_view> choices = {};
    std::uint8_t default_choice = 0;
    double lowest = 0, highest = 0, default_number = 0;  ///< of a number; in the unit that `meaning` names
    std::optional<SettingOwner> owner = std::nullopt;    ///< where it is not the effect's
};

}  // namespace blush
