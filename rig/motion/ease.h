#pragma once
/// How a value goes from one to the next: the easing of a key, and of what a script feels.

#include <cstdint>
#include <optional>
#include <string_view>

namespace blush {

/// `smooth` is that of a curve through several keys; between two values alone it is ease_in_out.
enum class Ease : std::uint8_t { smooth, linear, step, ease_in, ease_out, ease_in_out };

/// By its name in files and scripts: "smooth", "linear", "step", "ease-in", "ease-out", "ease-in-out".
std::optional<Ease> find_ease(std::string_view name);

/// Slopes at both ends of the cubic that goes from 0 to 1 as `ease` says. ease_in is u^2, ease_out 2 u - u^2,
/// ease_in_out and smooth 3 u^2 - 2 u^3; step has no slopes that would make it one.
struct EaseSlopes {
    double start = 0, end = 0;
};
EaseSlopes slopes_of(Ease ease);

/// The share of the way at `u`, which is limited to 0..1: 0 at 0, 1 at 1, never falling; a step goes at 1.
double ease_at(Ease ease, double u);

}  // namespace blush
