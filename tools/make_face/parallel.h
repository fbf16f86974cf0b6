#pragma once
/// Splitting a loop over the machine's cores; the result does not depend on how many there are.

#include <algorithm>
#include <thread>
#include <vector>

namespace blush::make_face {

/// For tests: no more threads than this.
inline int most_threads = 16;

/// Calls `work(first, last)` for consecutive pieces of [0, count). Pieces must write to different places.
template <class Work>
void parallel_pieces(int count, Work work) {
    const int threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_threads);
    std::vector<std::jthread> running;
    for (int n = 0; n < threads; ++n)
        running.emplace_back([=] { work(count * n / threads, count * (n + 1) / threads); });
}

}  // namespace blush::make_face
