#pragma once
/// Random numbers from a seed: the same on every machine, small enough to be part of any state.

#include <cmath>
#include <cstdint>

namespace blush {

/// splitmix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// 0 <= result < 1
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// low <= result < high
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Waiting time of events that come at random, `mean` apart on average; finite.
    double waiting(double mean) { return -mean * std::log1p(-unit()); }

private:
    std::uint64_t state_;
};

}  // namespace blush
