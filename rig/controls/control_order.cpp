#include "rig/controls/control_order.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>

namespace blush {

ControlOrder order_controls(std::span<const Dependence> dependences) {
    struct Node {
        std::vector<std::uint32_t> next;
        std::size_t waits_for = 0;
    };
    std::map<std::uint32_t, Node> nodes;
    for (const auto& [before, after] : dependences) {
        nodes[before].next.push_back(after);
        ++nodes[after].waits_for;
    }
    std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, std::greater<>> ready;
    for (const auto& [control, node] : nodes) {
        if (node.waits_for == 0) ready.push(control);
    }
    ControlOrder result;
    while (!ready.empty()) {
        const std::uint32_t control = ready.top();
        ready.pop();
        result.order.push_back(control);
        for (const std::uint32_t next : nodes[control].next) {
            if (--nodes[next].waits_for == 0) ready.push(next);
        }
    }
    if (result.order.size() == nodes.size()) return result;

    // Each control that is left waits for another one that is left: going back from any of them must meet itself.
    std::map<std::uint32_t, std::uint32_t> cause;
    for (const auto& [before, after] : dependences) {
        if (nodes[before].waits_for > 0 && nodes[after].waits_for > 0) cause[after] = before;
    }
    std::uint32_t at = cause.begin()->first;
    std::vector<std::uint32_t> path;
    while (std::ranges::find(path, at) == path.end()) {
        path.push_back(at);
        at = cause[at];
    }
    path.erase(path.begin(), std::ranges::find(path, at));
    result.cycle.assign(path.rbegin(), path.rend());
    std::rotate(result.cycle.begin(), std::ranges::min_element(result.cycle), result.cycle.end());
    return result;
}

}  // namespace blush
