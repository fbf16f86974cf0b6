/// blush kernel: the separable diffusion kernel, and its fit to a profile.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "rig/light/diffusion_profile.h"
#include "tools/blush/commands.h"
#include "tools/blush/kernel_fit.h"

namespace blush::tool {
namespace {

struct Options {
    std::string fit;
    std::uint32_t samples = 17;
    double width = 1.12, range_mm = 12;
    int steps = 40;
};

using Profile = std::function<glm::dvec3(double)>;

std::string known_profiles() {
    std::string names = "skin, skin4";
    for (const ScatteringMaterial& material : measured_materials()) names += ", " + std::string(material.name);
    return names;
}

/// Rows of "distance_mm, red, green, blue", ascending, read between by straight lines, 0 beyond the last.
Result<Profile> read_profile(const std::string& path) {
    std::ifstream file(path);
    if (!file) return Error{path + ": cannot be opened (profiles known by name: " + known_profiles() + ")"};
    std::vector<std::pair<double, glm::dvec3>> rows;
    std::string line;
    constexpr std::size_t most_rows = 100'000;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        if (line.empty() || line[0] == '#') continue;
        std::ranges::replace(line, ',', ' ');
        std::istringstream in(line);
        double r = 0;
        glm::dvec3 value(0);
        const std::string place = path + ": line " + std::to_string(number) + ": ";
        if (!(in >> r >> value.r >> value.g >> value.b) || !std::isfinite(r + value.r + value.g + value.b)) {
            return Error{place + "not four finite numbers: millimetres, red, green, blue"};
        }
        if (r < 0 || (!rows.empty() && r <= rows.back().first)) return Error{place + "distances do not ascend from 0"};
        if (glm::min(value, glm::dvec3(0)) != glm::dvec3(0)) return Error{place + "a value is below 0"};
        if (rows.size() == most_rows) return Error{path + ": more than 100000 rows"};
        rows.emplace_back(r, value);
    }
    if (rows.size() < 2) return Error{path + ": fewer than two rows of millimetres, red, green, blue"};
    return Profile([rows](double r) {
        const auto next = std::ranges::upper_bound(rows, r, {}, &std::pair<double, glm::dvec3>::first);
        if (next == rows.end()) return glm::dvec3(0);
        if (next == rows.begin()) return next->second;
        const auto before = next - 1;
        return glm::mix(before->second, next->second, (r - before->first) / (next->first - before->first));
    });
}

Result<Profile> profile_named(const std::string& name) {
    if (name == "skin") return Profile([](double r) { return profile_at(skin_six_gaussians(), r); });
    if (name == "skin4") return Profile([](double r) { return profile_at(skin_four_gaussians(), r); });
    for (const ScatteringMaterial& material : measured_materials()) {
        if (material.name == name) return Profile([&material](double r) { return dipole_at(material, r); });
    }
    return read_profile(name);
}

void print_shape(const char* name, const KernelShape& shape) {
    std::printf("%s: width %.4g, strength %.4f %.4f %.4f, falloff %.4f %.4f %.4f\n", name, shape.width,
                shape.strength.r, shape.strength.g, shape.strength.b, shape.falloff.r, shape.falloff.g,
                shape.falloff.b);
}

void print_taps(const KernelShape& shape, std::uint32_t samples) {
    std::printf("offset_mm,red,green,blue\n");
    for (const KernelTap& tap : separable_kernel(shape, samples)) {
        std::printf("%.6f,%.9f,%.9f,%.9f\n", tap.offset_mm, tap.weight.r, tap.weight.g, tap.weight.b);
    }
}

int run(const Options& options) {
    if (options.fit.empty()) {
        print_shape("skin", skin_kernel_shape());
        print_taps(skin_kernel_shape(), options.samples);
        return 0;
    }
    const Result<Profile> profile = profile_named(options.fit);
    if (!profile) return fail(profile.error());
    const FitSamples samples = fit_samples(*profile, options.range_mm, options.steps);
    const glm::dvec3 energy = fit_error(samples, {options.width, glm::dvec3(0), glm::dvec3(0.01)});
    if (!(energy.r + energy.g + energy.b > 0) || !std::isfinite(energy.r + energy.g + energy.b)) {
        return fail({options.fit + ": the profile has no light within " + std::to_string(options.range_mm) + " mm"});
    }
    const KernelFit found = fit_kernel(samples, options.width);
    print_shape("fitted", found.shape);
    std::printf("error of the light in %d x %d cells (root of the sum of squares): %.5f %.5f %.5f%s\n", options.steps,
                options.steps, std::sqrt(found.error.r), std::sqrt(found.error.g), std::sqrt(found.error.b),
                found.converged ? "" : " (not converged)");
    print_shape("table 6.1", printed_kernel_shape());
    const glm::dvec3 printed = fit_error(samples, printed_kernel_shape());
    std::printf("its error: %.5f %.5f %.5f\n", std::sqrt(printed.r), std::sqrt(printed.g), std::sqrt(printed.b));
    std::printf("energy of the singular values (figure 6.2), red green blue, %%:\n");
    for (const glm::dvec3& share : singular_energy(samples, 5)) {
        std::printf("  %.3f %.3f %.3f\n", 100 * share.r, 100 * share.g, 100 * share.b);
    }
    print_taps(found.shape, options.samples);
    return 0;
}

}  // namespace

void add_kernel(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("kernel", "Print the separable diffusion kernel, or fit it to a profile");
    command.option("--fit", &options->fit,
                   "Fit to a profile: " + known_profiles() + ", or a file of millimetres,red,green,blue rows");
    command.option("--samples", &options->samples, "Taps").one_of({"9", "17", "25", "33"}).shows_default();
    command.option("--width", &options->width, "Width; falloffs are found relative to it")
        .range(0.01, 1000)
        .shows_default();
    command.option("--range", &options->range_mm, "Millimetres within which the kernel is held to the profile")
        .range(0.01, 1000)
        .shows_default();
    command.option("--steps", &options->steps, "Cells along a side of the quarter plane").range(4, 200).shows_default();
    command.runs([options] { return run(*options); });
}

}  // namespace blush::tool
