#pragma once
// What four threads do at the same moment. `./run check` runs the tests that use it under ThreadSanitizer.

#include <array>
#include <barrier>
#include <thread>

namespace blush::test {

inline constexpr std::size_t thread_count = 4;

/// What work(0) to work(3) return, each on a thread of its own; all begin together.
template <class Work>
auto on_four_threads(const Work& work) {
    std::array<decltype(work(std::size_t{0})), thread_count> results;
    std::barrier begin(thread_count);
    std::array<std::jthread, thread_count> threads;
    for (std::size_t i = 0; i < thread_count; ++i) {
        threads[i] = std::jthread([&, i] {
            begin.arrive_and_wait();
            results[i] = work(i);
        });
    }
    for (std::jthread& thread : threads) thread.join();
    return results;
}

}  // namespace blush::test
