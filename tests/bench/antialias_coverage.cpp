// How far each filter, and each mode of antialiasing, is from the true coverage, over half planes, wedges, corners and
// thin lines. The filters run on the CPU; the frames draw the same shapes as geometry. Exit status 1 where SMAA 4x is
// no nearer than multisampling with four samples.
//   antialias_coverage [STEP_OF_DEGREES [OFFSETS]]

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
    // The places of two samples, whatever the device makes of multisampling with two.
    all.push_back({"frame: MSAA 2x", [drawn, none](std::size_t s) {
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
    add("frame: 4 x 4", in_mode("supersampled"));
    add("shown: MSAA 4x",
        {{{"antialiasing.mode", "msaa4"}, {"multisampling.resolve", "average"}}, Output::display_srgb});
    add("shown: MSAA 4x hdr",
        {{{"antialiasing.mode", "msaa4"}, {"multisampling.resolve", "hdr"}}, Output::display_srgb});
    add("shown: SMAA 4x", {{{"antialiasing.mode", "smaa_4x"}}, Output::display_srgb});
    add("shown: 4 x 4", {{{"antialiasing.mode", "supersampled"}}, Output::display_srgb});
    return all;
}

int run(const CoverageDensity& density) {
    Result<Device> device = Device::headless(false);
    if (!device) {
        std::fprintf(stderr, "antialias_coverage: %s\n", device.error().message.c_str());
        return 2;
    }
    const std::vector<CoverageShape> shapes = coverage_shapes(density);
    std::vector<Method> all = filters(shapes);
    const std::size_t reference = all.size() - 1;
    // Twice the white of a display, so that a plain mean of radiances is too bright once shown.
    constexpr float radiance = 4;
    for (Method& method : frames(std::make_shared<CoverageFrames>(*device, shapes, radiance))) {
        all.push_back(std::move(method));
    }
    std::map<std::string, std::vector<CoverageError>> errors;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        const CoverageShape& shape = shapes[s];
        const Grid<double> truth = exact_coverage(shape);
        for (const std::string& family : {shape.family, std::string("all")}) {
            errors[family].resize(all.size());
        }
        for (std::size_t m = 0; m < all.size(); ++m) {
            const CoverageError error = coverage_error(all[m].show(s), truth);
            errors[shape.family][m].add(error);
            errors["all"][m].add(error);
        }
    }
    bool ordered = true;
    for (const auto& [family, rows] : errors) {
        std::printf("%s: mean error a contour pixel, worst error, share of the gap to supersampling closed\n",
                    family.c_str());
        const double gap = rows.front().mean() - rows[reference].mean();
        for (std::size_t m = 0; m < all.size(); ++m) {
            std::printf("  %-22s %7.4f %7.4f %6.1f %%\n", all[m].name, rows[m].mean(), rows[m].worst,
                        100 * (rows.front().mean() - rows[m].mean()) / gap);
        }
        ordered &= gap > 0;
        const auto row = [&all, &rows = rows](const std::string& name) {
            const auto found =
                std::ranges::find(all, name, [](const Method& method) { return std::string(method.name); });
            return rows[static_cast<std::size_t>(found - all.begin())].mean();
        };
        // Geometry and the CPU's sampling are the same picture; and 4x is worth its name.
        if (family == "all")
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
    return blush::run(density);
}
