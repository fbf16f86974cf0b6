#pragma once
/// In which order controls are worked out: whatever drives a control comes before it.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace blush {

/// `first` must come before `second`.
using Dependence = std::pair<std::uint32_t, std::uint32_t>;

struct ControlOrder {
    std::vector<std::uint32_t> order;  ///< every control that a dependence names; of equals, the lower one first
    std::vector<std::uint32_t> cycle;  ///< controls each of which drives the next and the last the first; empty: none
};

/// Kahn 1962. Controls of a cycle, and what depends on them, are not in `order`.
ControlOrder order_controls(std::span<const Dependence> dependences);

}  // namespace blush
