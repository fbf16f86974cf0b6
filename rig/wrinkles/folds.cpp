#include "rig/wrinkles/folds.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace blush {
namespace {

constexpr double pi = 3.14159265358979;
constexpr float finest_cycles_a_texel = 0.25F;
// Kernels are shared by waves of about the same direction and length: steps of 5 degrees and of a twelfth of an octave,
// both well below what the eye tells apart in a ridge pattern.
constexpr int directions = 36;
constexpr double lengths_an_octave = 12;

/// An even Gabor kernel without a mean: one wave under a bell of its own width, so that a constant gives 0 and folds of
/// its spacing reinforce themselves. A little longer along the fold than across it, which keeps folds in one piece.
struct Kernel {
    int radius = 0;
    std::vector<float> taps;
};

Kernel make_kernel(double angle, double cycles_a_texel) {
    const double across = 0.45 / cycles_a_texel, along = 1.6 * across;  // standard deviations, texels
    Kernel kernel{std::max(2, static_cast<int>(std::ceil(2.2 * along))), {}};
    const int side = 2 * kernel.radius + 1;
    double sum = 0, bell_sum = 0;
    std::vector<double> wave, bell;
    for (int i = 0; i < side * side; ++i) {
        const double x = i % side - kernel.radius, y = i / side - kernel.radius;
        const double u = x * std::cos(angle) + y * std::sin(angle), v = y * std::cos(angle) - x * std::sin(angle);
        bell.push_back(std::exp(-0.5 * (u * u / (across * across) + v * v / (along * along))));
        wave.push_back(bell.back() * std::cos(2 * pi * cycles_a_texel * u));
        sum += wave.back();
        bell_sum += bell.back();
    }
    double gain = 0;
    for (std::size_t i = 0; i < wave.size(); ++i) {
        wave[i] -= bell[i] * sum / bell_sum;
        gain += std::abs(wave[i]);
    }
    for (const double tap : wave) kernel.taps.push_back(static_cast<float>(tap / gain));
    return kernel;
}

class Kernels {
public:
    const Kernel& of(glm::vec2 wave) {
        const float length = std::min(glm::length(wave), finest_cycles_a_texel);
        double angle = std::atan2(static_cast<double>(wave.y), static_cast<double>(wave.x)) / pi * directions;
        const int turn = (static_cast<int>(std::lround(angle)) % directions + directions) % directions;
        const int octave = static_cast<int>(std::lround(std::log2(static_cast<double>(length)) * lengths_an_octave));
        Kernel& kernel = kernels_[{turn, octave}];
        if (kernel.taps.empty()) {
            kernel = make_kernel(turn * pi / directions, std::exp2(octave / lengths_an_octave));
        }
        return kernel;
    }

private:
    std::map<std::pair<int, int>, Kernel> kernels_;
};

}  // namespace

// The mixing steps of Jenkins' one-at-a-time hash.
float noise_at(std::uint32_t texel, std::uint32_t seed) {
    std::uint32_t hash = seed * 0x9E3779B9U + texel;
    hash += hash << 10U;
    hash ^= hash >> 6U;
    hash += hash << 3U;
    hash ^= hash >> 11U;
    hash += hash << 15U;
    return static_cast<float>(hash >> 8U) / 8388608.0F - 1;
}

std::vector<float> grow_folds(std::span<const glm::vec2> wave, std::uint32_t width, std::uint32_t height,
                              std::uint32_t seed) {
    assert(wave.size() == std::size_t{width} * height && "one wave vector for each texel");
    // A wave that would not repeat within the map is no fold.
    const float longest = 1.0F / static_cast<float>(std::max({width, height, 1U}));
    Kernels kernels;
    std::vector<const Kernel*> kernel_of(wave.size(), nullptr);
    std::vector<float> folds(wave.size(), 0), next(wave.size(), 0);
    for (std::size_t i = 0; i < wave.size(); ++i) {
        const float length = glm::length(wave[i]);
        if (!std::isfinite(length) || length < longest) continue;
        kernel_of[i] = &kernels.of(wave[i]);
        folds[i] = noise_at(static_cast<std::uint32_t>(i), seed);
    }
    // Seven rounds: by then the pattern has settled (the eighth changes it by less than a hundredth on average).
    constexpr int rounds = 7;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < wave.size(); ++i) {
            if (kernel_of[i] == nullptr) continue;
            const Kernel& kernel = *kernel_of[i];
            const int x = static_cast<int>(i % width), y = static_cast<int>(i / width), r = kernel.radius;
            const int first_x = std::max(0, x - r), last_x = std::min(static_cast<int>(width) - 1, x + r);
            float sum = 0;
            for (int from_y = std::max(0, y - r); from_y <= std::min(static_cast<int>(height) - 1, y + r); ++from_y) {
                const float* const row = &folds[static_cast<std::size_t>(from_y) * width];
                const float* const taps =
                    &kernel.taps[static_cast<std::size_t>((from_y - y + r) * (2 * r + 1) + (r - x))];
                for (int from_x = first_x; from_x <= last_x; ++from_x) sum += row[from_x] * taps[from_x];
            }
            // Grown until it saturates: ridges and valleys end at -1 and 1.
            constexpr float growth = 4;
            next[i] = std::tanh(growth * sum);
        }
        std::swap(folds, next);
    }
    return folds;
}

}  // namespace blush
