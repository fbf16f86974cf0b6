// How far each filter, and each mode of antialiasing, is from the true coverage, over half planes, wedges, corners and
// thin lines: mean and worst error, and the share of the gap between one sample and 64 that is closed. The filters run
// on the CPU; the frames draw the same shapes as geometry. Exit status 1 where SMAA is no nearer than MLAA, or SMAA 4x
// no nearer than multisampling with four samples.
//   antialias_coverage [STEP_OF_DEGREES [OFFSETS [filters]]]
// filters: leave the frames out.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>

#include "rig/antialias/blend.h"
#include "rig/antialias/coverage.h"
#include "tests/bench/coverage_frames.h"

namespace blush {
namespace {

struct Method {
    const char* name;
    std::function<Grid<double>(std::size_t)> show;  // of shape number ...
};

std::vector<Method> filters(const std::vector<CoverageShape>& shapes) {
    const PictureMeaning linear{.transfer = Transfer::linear};
    std::vector<Method> all;
    all.push_back({"none", [&](std::size_t s) { return shown_coverage(sampled(shapes[s])); }});
    all.push_back(
        {"MLAA", [=, &shapes](std::size_t s) { return shown_coverage(mlaa(sampled(shapes[s]), {}, {}, linear)); }});
    for (std::size_t p = 0; p < smaa_preset_names.size(); ++p) {
        const SmaaSettings settings = smaa_preset(static_cast<SmaaPreset>(p));
        static const char* const names[] = {"SMAA 1x low", "SMAA 1x medium", "SMAA 1x high", "SMAA 1x ultra"};
        all.push_back({names[p], [=, &shapes](std::size_t s) {
                           return shown_coverage(smaa(sampled(shapes[s]), {}, settings, linear));
                       }});
    }
    all.push_back({"supersampling 64", [&](std::size_t s) { return supersampled(shapes[s], 8); }});
    return all;
}

Grid<double> mean(const Grid<double>& a, const Grid<double>& b) {
    Grid<double> mean = a;
    for (std::size_t i = 0; i < mean.cells.size(); ++i) mean.cells[i] = (a.cells[i] + b.cells[i]) / 2;
    return mean;
}

constexpr const char* first_of_frames = "frame: none";
constexpr const char* multisampled = "frame: MSAA 4x";
constexpr const char* smaa_4x = "frame: SMAA 4x";

std::vector<Method> frames(const std::shared_ptr<CoverageFrames>& drawn) {
    std::vector<Method> all;
    const auto add = [&](const char* name, const CoverageFrames::Mode& mode) {
        const std::size_t number = drawn->add(mode);
        all.push_back({name, [drawn, number](std::size_t s) { return drawn->show(number, s); }});
        return number;
    };
    const auto in_mode = [](const char* mode) { return CoverageFrames::Mode{{{"antialiasing.mode", mode}}}; };
    const std::size_t none = add(first_of_frames, in_mode("none"));
    // llvmpipe has no two samples, so their places are drawn one by one. Samples of multisampling differ in coverage
    // alone, and these shapes are of one radiance.
    all.push_back({"frame: MSAA 2x (drawn)", [drawn, none](std::size_t s) {
                       return mean(drawn->show(none, s, {-0.25, -0.25}), drawn->show(none, s, {0.25, 0.25}));
                   }});
    add(multisampled, in_mode("msaa4"));
    add("frame: MLAA", in_mode("mlaa"));
    for (const char* preset : {"low", "medium", "high", "ultra"}) {
        static const std::map<std::string, const char*> names = {{"low", "frame: SMAA 1x low"},
                                                                 {"medium", "frame: SMAA 1x medium"},
                                                                 {"high", "frame: SMAA 1x high"},
                                                                 {"ultra", "frame: SMAA 1x ultra"}};
        add(names.at(preset), {{{"antialiasing.mode", "smaa_1x"}, {"antialiasing.preset", preset}}});
    }
    add("frame: SMAA S2x", in_mode("smaa_s2x"));
    add("frame: SMAA T2x", in_mode("smaa_t2x"));
    add(smaa_4x, in_mode("smaa_4x"));
    add("shown: MSAA 4x average",
        {{{"antialiasing.mode", "msaa4"}, {"multisampling.resolve", "average"}}, Output::display_srgb});
    add("shown: MSAA 4x hdr",
        {{{"antialiasing.mode", "msaa4"}, {"multisampling.resolve", "hdr"}}, Output::display_srgb});
    add("shown: SMAA 4x", {{{"antialiasing.mode", "smaa_4x"}}, Output::display_srgb});
    return all;
}

/// Errors of every method over the shapes of each family, and of all.
using Errors = std::map<std::string, std::vector<CoverageError>>;

void measure(const std::vector<CoverageShape>& shapes, const std::vector<Method>& methods, Errors& errors) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const Grid<double> truth = exact_coverage(shapes[s]);
        std::vector<std::string> families = {shapes[s].family, "all"};
        const bool diagonal = shapes[s].degrees >= 30 && shapes[s].degrees <= 60;
        if (diagonal && shapes[s].family == "half planes")
            families.emplace_back("diagonals: half planes of 30 to 60 degrees");
        for (const std::string& family : families) errors[family].resize(methods.size());
        for (std::size_t m = 0; m < methods.size(); ++m) {
            const CoverageError error = coverage_error(methods[m].show(s), truth);
            for (const std::string& family : families) errors[family][m].add(error);
        }
    }
}

int run(const CoverageDensity& density, bool with_frames) {
    Result<Device> device = Device::headless(false);
    if (!device) {
        std::fprintf(stderr, "antialias_coverage: %s\n", device.error().message.c_str());
        return 2;
    }
    const std::vector<CoverageShape> every_shape = coverage_shapes(density);
    Errors errors;
    std::vector<std::string> names;
    // A few shapes at a time: every picture runs through all vertices of the face that holds them.
    constexpr std::size_t shapes_a_face = 256;
    for (std::size_t first = 0; first < every_shape.size(); first += shapes_a_face) {
        const auto from = every_shape.begin() + static_cast<std::ptrdiff_t>(first);
        const auto to = from + static_cast<std::ptrdiff_t>(std::min(shapes_a_face, every_shape.size() - first));
        const std::vector<CoverageShape> shapes(from, to);
        std::vector<Method> methods = filters(shapes);
        // Twice the white of a display, so that a plain mean of radiances is too bright once shown.
        constexpr float radiance = 4;
        if (with_frames) {
            std::ranges::move(frames(std::make_shared<CoverageFrames>(*device, shapes, radiance)),
                              std::back_inserter(methods));
        }
        names.clear();
        for (const Method& method : methods) names.emplace_back(method.name);
        measure(shapes, methods, errors);
    }
    bool ordered = true;
    for (const auto& [family, rows] : errors) {
        const auto row = [&names, &rows = rows](const std::string& name) {
            return rows[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())].mean();
        };
        std::printf("%s: mean error a contour pixel, worst error, share of the gap to supersampling closed\n",
                    family.c_str());
        const double gap = row("none") - row("supersampling 64");
        for (std::size_t m = 0; m < names.size(); ++m) {
            std::printf("  %-22s %7.4f %7.4f %6.1f %%\n", names[m].c_str(), rows[m].mean(), rows[m].worst,
                        100 * (row("none") - rows[m].mean()) / gap);
        }
        ordered &= gap > 0;
        if (family != "all") continue;  // of a family, a few shapes say little
        ordered &= row("SMAA 1x high") < row("MLAA");
        if (!with_frames) continue;
        // Geometry and the CPU's sampling are the same picture; and 4x is worth its name.
        ordered &= std::abs(row(first_of_frames) - row("none")) < 0.002 && row(smaa_4x) < row(multisampled);
    }
    return ordered ? 0 : 1;
}

}  // namespace
}  // namespace blush

int main(int argc, char** argv) {
    blush::CoverageDensity density;
    if (argc > 1) density.degrees = std::max(1, std::atoi(argv[1]));
    if (argc > 2) density.offsets = std::max(1, std::atoi(argv[2]));
    return blush::run(density, argc <= 3);
}
