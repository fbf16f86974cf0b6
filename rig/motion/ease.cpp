#include "rig/motion/ease.h"

#include <array>
#include <utility>

namespace blush {

std::optional<Ease> find_ease(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Ease>, 6> known = {{{"smooth", Ease::smooth},
                                                                         {"linear", Ease::linear},
                                                                         {"step", Ease::step},
                                                                         {"ease-in", Ease::ease_in},
                                                                         {"ease-out", Ease::ease_out},
                                                                         {"ease-in-out", Ease::ease_in_out}}};
    for (const auto& [text, ease] : known) {
        if (name == text) return ease;
    }
    return std::nullopt;
}

EaseSlopes slopes_of(Ease ease) {
    switch (ease) {
        case Ease::linear:
            return {1, 1};
        case Ease::ease_in:
            return {0, 2};
        case Ease::ease_out:
            return {2, 0};
        default:
            return {0, 0};
    }
}

double ease_at(Ease ease, double u) {
    if (!(u > 0)) return 0;
    if (u >= 1) return 1;
    if (ease == Ease::step) return 0;
    const auto [start, end] = slopes_of(ease);
    // The cubic Hermite curve from 0 to 1, by powers of u.
    return u * (start + u * ((3 - 2 * start - end) + u * (start + end - 2)));
}

}  // namespace blush
