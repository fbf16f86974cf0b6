#pragma once
/// An effect's settings in its own file, by place: a frame compares no names.

#include <cstdint>
#include <string_view>

#include "runtime/frame/effect.h"
#include "runtime/settings.h"

namespace blush {

/// A setting of `effect` by its name in `settings`, the array that the effect points to; the compiler finds its place,
/// and a name that is not there does not compile. `using Own = OwnSetting<bloom_effect, settings>;` and then
/// `frame.settings.number(Own("strength"))`.
template <const Effect& effect, const auto& settings>
struct OwnSetting {
    SettingId id;

    // NOLINTNEXTLINE(google-explicit-constructor)
    consteval OwnSetting(const char* name) : id{&effect, place_of(name)} {}
    // NOLINTNEXTLINE(google-explicit-constructor)
    constexpr operator SettingId() const { return id; }

private:
    static consteval std::uint16_t place_of(const char* name) {
        for (std::size_t s = 0; s < settings.size(); ++s) {
            if (settings[s].name == std::string_view(name)) return static_cast<std::uint16_t>(s);
        }
        throw "the effect has no such setting";  // ends the compilation
    }
};

}  // namespace blush
