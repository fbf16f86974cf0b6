#pragma once
/// The settings of all effects, by name ("deformation.method"), each one of a few named choices.

#include <cstdint>
#include <string_view>
#include <vector>

#include "rig/result.h"

namespace blush {

class EffectSettings {
public:
    EffectSettings();  ///< every setting at its default

    /// Error: no such setting or no such choice; the message lists what there is.
    Status set(std::string_view setting, std::string_view choice);
    /// Index of the choice made. The setting must exist.
    std::uint8_t choice(std::string_view effect, std::string_view setting) const;

    bool operator==(const EffectSettings&) const = default;

private:
    std::vector<std::uint8_t> choices_;  // of every setting of every effect, in the registry's order
};

}  // namespace blush
