// How far each filter is from the true coverage, over half planes, wedges, corners and thin lines.
//   antialias_coverage [STEP_OF_DEGREES [OFFSETS]]

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>

#include "rig/antialias/blend.h"
#include "rig/antialias/coverage.h"

namespace blush {
namespace {

struct Method {
    const char* name;
    std::function<Grid<double>(const CoverageShape&)> show;
};

std::vector<Method> methods() {
    const PictureMeaning linear{.transfer = Transfer::linear};
    std::vector<Method> all;
    all.push_back({"none", [](const CoverageShape& shape) { return shown_coverage(sampled(shape)); }});
    all.push_back(
        {"MLAA", [=](const CoverageShape& shape) { return shown_coverage(mlaa(sampled(shape), {}, {}, linear)); }});
    for (std::size_t p = 0; p < smaa_preset_names.size(); ++p) {
        const SmaaSettings settings = smaa_preset(static_cast<SmaaPreset>(p));
        static const char* const names[] = {"SMAA 1x low", "SMAA 1x medium", "SMAA 1x high", "SMAA 1x ultra"};
        all.push_back({names[p], [=](const CoverageShape& shape) {
                           return shown_coverage(smaa(sampled(shape), {}, settings, linear));
                       }});
    }
    all.push_back({"supersampling 64", [](const CoverageShape& shape) { return supersampled(shape, 8); }});
    return all;
}

int run(const CoverageDensity& density) {
    const std::vector<Method> all = methods();
    std::map<std::string, std::vector<CoverageError>> errors;
    for (const CoverageShape& shape : coverage_shapes(density)) {
        const Grid<double> truth = exact_coverage(shape);
        for (const std::string& family : {shape.family, std::string("all")}) {
            errors[family].resize(all.size());
        }
        for (std::size_t m = 0; m < all.size(); ++m) {
            const CoverageError error = coverage_error(all[m].show(shape), truth);
            errors[shape.family][m].add(error);
            errors["all"][m].add(error);
        }
    }
    bool ordered = true;
    for (const auto& [family, rows] : errors) {
        std::printf("%s: mean error a contour pixel, worst error, share of the gap to supersampling closed\n",
                    family.c_str());
        const double gap = rows.front().mean() - rows.back().mean();
        for (std::size_t m = 0; m < all.size(); ++m) {
            std::printf("  %-17s %7.4f %7.4f %6.1f %%\n", all[m].name, rows[m].mean(), rows[m].worst,
                        100 * (rows.front().mean() - rows[m].mean()) / gap);
        }
        ordered &= gap > 0;
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
