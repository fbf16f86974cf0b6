/// blush kernel, and lights from files.

#include <cmath>
#include <cstdio>
#include <sstream>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

using ::testing::HasSubstr;

/// The numbers of the line that starts with `label`.
std::vector<double> numbers_after(const std::string& text, const std::string& label) {
    std::vector<double> numbers;
    const std::size_t at = text.find(label);
    if (at == std::string::npos) return numbers;
    std::string line = text.substr(at + label.size(), text.find('\n', at) - at - label.size());
    for (char& c : line) {
        if ((c < '0' || c > '9') && c != '.') c = ' ';
    }
    std::istringstream in(line);
    for (double value = 0; in >> value;) numbers.push_back(value);
    return numbers;
}

TEST_F(Cli, TheKernelIsPrintedAndSumsToOne) {
    const Ran ran = blush("kernel --samples 25");
    ASSERT_EQ(ran.exit_status, 0) << ran.errors;
    std::istringstream lines(ran.output);
    std::string line;
    while (std::getline(lines, line) && line != "offset_mm,red,green,blue") {
    }
    double sums[3] = {};
    int rows = 0;
    for (double offset = 0, red = 0, green = 0, blue = 0;
         std::getline(lines, line) && std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &offset, &red, &green, &blue) == 4;
         ++rows) {
        sums[0] += red;
        sums[1] += green;
        sums[2] += blue;
    }
    EXPECT_EQ(rows, 25);
    for (const double sum : sums) EXPECT_NEAR(sum, 1, 1e-7);
}

TEST_F(Cli, TheFitToSkinGivesTheDefaultsAndBeatsTheTable) {
    const Ran ran = blush("kernel --fit skin");
    ASSERT_EQ(ran.exit_status, 0) << ran.errors;
    const std::vector<double> fitted = numbers_after(ran.output, "fitted:");
    const std::vector<double> defaults = numbers_after(blush("kernel").output, "skin:");
    ASSERT_EQ(fitted.size(), 7U) << ran.output;
    ASSERT_EQ(defaults.size(), 7U);
    for (std::size_t i = 0; i < fitted.size(); ++i) EXPECT_NEAR(fitted[i], defaults[i], 2e-3) << i;
    EXPECT_NEAR(fitted[4], 0.57, 0.02);  // table 6.1: the red falloff
    const std::vector<double> error = numbers_after(ran.output, "squares):"),
                              printed = numbers_after(ran.output, "its error:");
    ASSERT_GE(error.size(), 3U);
    ASSERT_EQ(printed.size(), 3U);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(error[c], 0.6 * printed[c]);
    // Figure 6.2: the first singular value holds most of the energy.
    EXPECT_THAT(ran.output, HasSubstr("energy of the singular values"));
}

TEST_F(Cli, AProfileFromAFileIsFitted) {
    std::string rows = "# a Gaussian of variance 0.5 mm^2\n";
    for (int i = 0; i < 200; ++i) {
        const double r = 0.03 * i, value = std::exp(-r * r);
        rows += std::to_string(r) + "," + std::to_string(value) + "," + std::to_string(value) + "," +
                std::to_string(value) + "\n";
    }
    write("profile.csv", rows);
    const Ran ran = blush("kernel --fit profile.csv --range 4");
    ASSERT_EQ(ran.exit_status, 0) << ran.errors;
    EXPECT_EQ(numbers_after(ran.output, "fitted:").size(), 7U);
    write("bad.csv", "0,1,1,1\n0.5,1,one,1\n");
    expect_refused("kernel --fit bad.csv", "bad.csv: line 2: not four finite numbers: millimetres, red, green, blue");
    write("dark.csv", "0,0,0,0\n1,0,0,0\n");
    EXPECT_EQ(blush("kernel --fit dark.csv").exit_status, 2);
}

TEST_F(Cli, LightsComeFromFilesAndByName) {
    write("lights.json",
          R"({"sky": [0.1, 0.1, 0.1], "lights": [{"kind": "spot", "at_mm": [0, 100, 500], "radiance": [3, 3, 3]},
              {"kind": "directional", "from": [1, 0, 0], "radiance": [0, 0, 1], "casts_shadow": false}]})");
    expect_works("render face.glb --size 24x24 --lights lights.json -o lit.png");
    expect_works("render face.glb --size 24x24 --lights behind -o behind.png");
    EXPECT_NE(bytes_of("lit.png"), bytes_of("behind.png"));
    // Half an orbit turns a light from the front to the back, a whole one back again.
    const std::string light = R"({"lights": [{"kind": "directional", "radiance": [1, 1, 1], "from": )";
    write("orbit.json", light + R"([0.6, 0.1, 0.8], "orbit_seconds": 2}]})");
    write("half.json", light + R"([-0.6, 0.1, -0.8]}]})");
    for (const char* at : {"0", "1", "2"}) {
        const std::string moment(at);
        expect_works("render face.glb --size 24x24 --lights orbit.json --at " + moment + " -o orbit" + moment + ".png");
    }
    expect_works("render face.glb --size 24x24 --lights half.json -o half.png");
    expect_same("orbit0.png", "orbit2.png");
    expect_same("orbit1.png", "half.png");
    EXPECT_NE(bytes_of("orbit0.png"), bytes_of("half.png"));
    write("fast.json", light + R"([1, 0, 0], "orbit_seconds": 0.01}]})");
    expect_refused("render face.glb --size 24x24 --lights fast.json -o x.png",
                   "--lights: fast.json: lights[0].orbit_seconds: a light goes round in a tenth of a second at least");
    expect_refused("render face.glb --size 24x24 --lights sunny -o x.png",
                   "--lights: there is no lighting \"sunny\" (there are: front, side, behind, orbit; or a .json file)");
    write("bad.json", R"({"lights": [{"kind": "laser"}]})");
    expect_refused("render face.glb --size 24x24 --lights bad.json -o x.png",
                   "--lights: bad.json: lights[0].kind: it is none of directional, point, spot");
    write("nan.json", R"({"lights": [{"kind": "directional", "from": [0, 0, 1e99], "radiance": [1, 1, 1]}]})");
    expect_refused("render face.glb --size 24x24 --lights nan.json -o x.png",
                   "--lights: nan.json: lights[0].from: a number in it is beyond 1000000.0");
    expect_refused("render face.glb --size 24x24 --environment nothing.hdr -o x.png",
                   "--environment: nothing.hdr: No such file or directory");
    expect_refused("render face.glb --size 24x24 --environment face.glb -o x.png",
                   "--environment: face.glb: the image is not PNG, JPEG, WebP, HDR or EXR");
}

}  // namespace
}  // namespace blush::test
