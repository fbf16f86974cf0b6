#pragma once
/// A baker does ahead of time what no frame could: `blush bake`. It is told as effects are, by settings (the command's
/// options) and hard cases, and studied under its name (runtime/measure/); but no frame asks it anything. No GL.

#include <span>
#include <string_view>

#include "runtime/frame/hard_case.h"
#include "runtime/frame/setting.h"

namespace blush {

struct Baker {
    std::string_view name;
    std::string_view what;
    std::span<const Setting> settings;  ///< none has an owner
    std::span<const HardCase> hard_cases;
};

extern const Baker wrinkle_baker, appearance_baker;

/// All bakers that are told so.
std::span<const Baker* const> bakers();

}  // namespace blush
