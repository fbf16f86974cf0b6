#include "rig/light/separable_kernel.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "rig/light/diffusion_profile.h"

namespace blush {
namespace {

/// Integral over the line of the red profile as eq. 6.1 takes it: a function of one coordinate, not a line integral.
double base_total() {
    double total = 0;
    for (const GaussianTerm& term : skin_six_gaussians().subspan(1)) {
        total += term.weight.r / std::sqrt(2 * std::numbers::pi * term.variance_mm2);
    }
    return total;
}

}  // namespace

KernelShape skin_kernel_shape() { return {1.12, {0.969, 1.0, 1.0}, {0.580, 0.267, 0.215}}; }

KernelShape printed_kernel_shape() { return {0.014 * 240 / 3, {0.78, 0.70, 0.75}, {0.57, 0.13, 0.08}}; }

double base_profile(double x_mm) {
    static const double total = base_total();
    return profile_at(skin_six_gaussians().subspan(1), x_mm).r / total;
}

double base_profile_integral(double x_mm) {
    static const double total = base_total();
    double sum = 0;
    for (const GaussianTerm& term : skin_six_gaussians().subspan(1)) {
        const double share = term.weight.r / std::sqrt(2 * std::numbers::pi * term.variance_mm2);
        sum += share * 0.5 * std::erfc(-x_mm / std::sqrt(2 * term.variance_mm2));
    }
    return sum / total;
}

double kernel_range_mm(const KernelShape& shape) { return 3 * shape.width; }

std::vector<KernelTap> separable_kernel(const KernelShape& shape, std::uint32_t count) {
    assert(count >= 3 && count % 2 == 1 && "separable_kernel: an odd number of taps");
    const double range = kernel_range_mm(shape);
    std::vector<KernelTap> taps(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double step = -1 + 2.0 * i / (count - 1);
        taps[i].offset_mm = range * std::copysign(step * step, step);
    }
    taps[count / 2].offset_mm = 0;
    for (glm::length_t c = 0; c < 3; ++c) {
        const double scale = shape.width * (0.001 + shape.falloff[c]);
        const auto until = [&](std::uint32_t i) {  // of the kernel's mass, as far as the end of tap i's cell
            if (i + 1 == count) return base_profile_integral(range / scale);
            return base_profile_integral(0.5 * (taps[i].offset_mm + taps[i + 1].offset_mm) / scale);
        };
        const double first = base_profile_integral(-range / scale);
        const double whole = until(count - 1) - first;
        double before = first;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double end = until(i);
            taps[i].weight[c] = shape.strength[c] * (end - before) / whole;
            before = end;
        }
        taps[count / 2].weight[c] += 1 - shape.strength[c];
    }
    return taps;
}

std::vector<KernelTap> preintegrated_kernel(std::span<const GaussianTerm> profile, double width, std::uint32_t count) {
    assert(count >= 3 && count % 2 == 1 && "preintegrated_kernel: an odd number of taps");
    const double range = 3 * width * std::sqrt(profile.back().variance_mm2);
    std::vector<KernelTap> taps(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double step = -1 + 2.0 * i / (count - 1);
        taps[i].offset_mm = 2 * i + 1 == count ? 0 : range * std::copysign(step * step, step);
    }
    // step_response() is the line integral's own integral.
    const auto until = [&](std::uint32_t i) {
        const double end = i + 1 == count ? range : 0.5 * (taps[i].offset_mm + taps[i + 1].offset_mm);
        return step_response(profile, end / width);
    };
    const glm::dvec3 first = step_response(profile, -range / width), whole = until(count - 1) - first;
    glm::dvec3 before = first;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 end = until(i);
        taps[i].weight = (end - before) / whole;
        before = end;
    }
    return taps;
}

}  // namespace blush
