#pragma once
/// Distance of floats in units in the last place.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/glm.hpp>

namespace blush::test {

/// Representable floats between a and b; +0 and -0 are one. Anything with a NaN is as far as can be.
inline std::uint32_t ulp_between(float a, float b) {
    if (a != a || b != b) return std::numeric_limits<std::uint32_t>::max();
    const auto ordered = [](float value) {
        const auto bits = std::bit_cast<std::int32_t>(value);
        return bits < 0 ? -(std::int64_t{bits} & 0x7fffffff) : std::int64_t{bits};
    };
    const std::int64_t difference = ordered(a) - ordered(b);
    return static_cast<std::uint32_t>(difference < 0 ? -difference : difference);
}

/// Worst difference of any component.
template <class Vector>
std::uint32_t worst_ulp(std::span<const Vector> a, std::span<const Vector> b) {
    if (a.size() != b.size()) return std::numeric_limits<std::uint32_t>::max();
    std::uint32_t worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (glm::length_t c = 0; c < Vector::length(); ++c) worst = std::max(worst, ulp_between(a[i][c], b[i][c]));
    }
    return worst;
}

}  // namespace blush::test
